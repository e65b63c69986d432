"""The examples of the docstrings run."""

import doctest

import piola


def test_docstrings():
    result = doctest.testmod(piola, verbose=False)
    assert result.attempted >= 10 and result.failed == 0
