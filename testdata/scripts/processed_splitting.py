"""Coefficients of a processed Runge-Kutta-Nystrom splitting of order six, to 34 digits.

The kernel, b1 a1 b2 a2 ... symmetric with seven forces, obeys the three conditions that no processor can take away (one of order
three, two of order five, beside the two sums). Of the kernels that do, it has a small error of order seven: a search from random
starts minimised the norm of the five combinations of order seven that no processor can take away, in the free Lie algebra of drift and
kick without [kick, [kick, [kick, drift]]]. The processor, drifts and kicks in turn whose sums vanish, was then found by Newton's method
with continuation, from random starts: its logarithm is the one that takes away all that a processor can, up to order seven.

This script takes the found values as the start of Newton's method on all order conditions of Nystrom's trees up to order six of
processor, kernel and inverse processor together, in 60 digits, with the smallest correction.

    python3 testdata/scripts/processed_splitting.py
"""

from mpmath import mpf, nstr

from nystrom_splittings import conditions, polish

KERNEL = [
    "0.2775415889889283", "-0.06087117030381333", "-0.14553737669048208", "0.32665236452538887", "0.2607223499643416",
    "0.31076000917312235",
]
PROCESSOR = [
    "-0.04634007358638243", "0.1361239242121275", "-0.25301825560179564", "0.030611421782795602", "0.2003036507075846",
    "-0.1368955000268619", "-0.5002897977667905", "-0.00226608979302667", "0.6627834331824901", "-0.03015089338619035",
    "0.6478698393606178", "-0.2666956258369578", "-0.23156336040679348", "0.044903975943058914", "0.28190289578473604",
    "0.2961277556470864", "0.038087738077455476", "-0.5188058246345564", "-0.2609752471384999", "-0.01513749771700412",
    "0.2509934654940514",
]
FREE = len(KERNEL)


def kernel(free):
    """Half of the palindrome b1 a1 b2 a2 ..., its middle included; the last kick and the last drift make the sums one."""
    half = list(free[:FREE])
    drift = 1 - 2 * sum(half[1::2])
    kick = mpf(1) / 2 - sum(half[0::2])
    return half + [kick, drift]


def processor(free):
    """Drifts and kicks in turn; the last of each make the sums zero."""
    first = list(free[FREE:])
    return first + [-sum(first[1::2]), -sum(first[0::2])]


def scheme(free):
    """Drifts and kicks of processor, kernel and inverse processor."""
    half, processing = kernel(free), processor(free)
    step = half + half[-2::-1]
    drifts, kicks = [mpf(0)], []
    for index, value in enumerate(processing):
        if index % 2:
            kicks.append(value)
            drifts.append(mpf(0))
        else:
            drifts[-1] += value
    for index, value in enumerate(step):
        if index % 2:
            drifts[-1] += value
        else:
            kicks.append(value)
            drifts.append(mpf(0))
    for index, value in enumerate(reversed(processing)):
        if index % 2:
            kicks.append(-value)
            drifts.append(mpf(0))
        else:
            drifts[-1] -= value
    return drifts, kicks


if __name__ == "__main__":
    start = [mpf(x) for x in KERNEL + PROCESSOR]
    free, residual, rank = polish(start, scheme, 6)
    moved = max(abs(x - y) for x, y in zip(free, start))
    print(f"residual {nstr(residual, 3)}, moved by {nstr(moved, 3)}, {rank} independent conditions")
    print("kernel   ", [nstr(x, 34) for x in kernel(free)])
    print("processor", [nstr(x, 34) for x in processor(free)])
    # At the doubles.
    half, processing = [[mpf(float(x)) for x in values] for values in (kernel(free), processor(free))]
    stored = half[:-2] + processing[:-2]
    print("residual at the doubles, the last ones from the exact sums", nstr(max(abs(x) for x in conditions(*scheme(stored), 6)), 3))
