"""Draws disc.png and letter.png: 96 x 96 samples of 8 bits, soft over half a sample.

    python3 data/images/phantoms.py
"""

import math
import pathlib
import struct
import zlib

N = 96


def write(name, inside):
    """`inside` is the distance to the edge, positive inside, in units of the side."""
    rows = b""
    for i in range(N):
        values = (inside((j + 0.5) / N - 0.5, (i + 0.5) / N - 0.5) for j in range(N))
        rows += b"\0" + bytes(round(255 / (1 + math.exp(min(700, -2 * N * value)))) for value in values)
    chunks = [(b"IHDR", struct.pack(">2I5B", N, N, 8, 0, 0, 0, 0)), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")]
    packed = [struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
              for kind, data in chunks]
    pathlib.Path(__file__).with_name(name).write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(packed))


write("disc.png", lambda x, y: 0.25 - math.hypot(x, y))
write("letter.png", lambda x, y: min(0.09 - abs(math.hypot(x, y) - 0.24), -min(x, 0.08 - abs(y))))
