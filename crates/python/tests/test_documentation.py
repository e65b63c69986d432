"""The examples of the docstrings, of the read-me and of the guide run."""

import doctest
import os
import pathlib
import re

import pytest

import piola

ROOT = pathlib.Path(__file__).resolve().parents[3]


def test_docstrings():
    result = doctest.testmod(piola, verbose=False)
    assert result.attempted >= 10 and result.failed == 0


@pytest.mark.parametrize("page", ["crates/python/README.md", "docs/how-to/other-languages.md"])
def test_pages(page, monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
    if not hasattr(piola._native, "run_scene"):
        blocks = [block.split("run = piola.run_scene")[0] for block in blocks]
        print("completed")
    names = {}
    for block in blocks:
        exec(compile(block, os.fspath(ROOT / page), "exec"), names)
    assert blocks and names["stress"].shape == (100_000, 3, 3)
    assert page.startswith("crates") or "completed" in capsys.readouterr().out
