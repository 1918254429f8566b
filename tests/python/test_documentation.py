"""Examples in docstrings run, those made from the declarations as those written by hand."""

import doctest
import importlib
from pathlib import Path

import pytest

import keyline
from keyline._operations import Namespace, declarations


ROOT = Path(__file__).resolve().parents[2]  # files of the examples are named from there


def functions():
    for name in keyline.__all__:
        thing = getattr(keyline, name)
        if isinstance(thing, Namespace):
            yield from ((f"{name}.{k}", v) for k, v in vars(thing).items() if hasattr(v, "__signature__"))
        elif hasattr(thing, "__signature__"):
            yield name, thing


@pytest.mark.parametrize("name, function", list(functions()))
def test_examples_of_operations(name, function, monkeypatch):
    monkeypatch.chdir(ROOT)
    finder = doctest.DocTestFinder(recurse=False)
    tests = finder.find(function, name, globs={"keyline": keyline})
    assert tests and tests[0].examples, "no example"
    for test in tests:
        assert doctest.DocTestRunner().run(test).failed == 0


@pytest.mark.parametrize("module", ["keyline", "keyline._values", "keyline._operations"])
def test_examples_of_the_package(module, monkeypatch):
    monkeypatch.chdir(ROOT)
    result = doctest.testmod(importlib.import_module(module), extraglobs={"keyline": keyline})
    assert result.failed == 0 and result.attempted > 0


def test_every_operation_is_a_function_that_tells_its_fields():
    known = dict(functions())
    for declaration in declarations():
        text = known[declaration.name].__doc__
        for field, schema in declaration.fields.items():
            assert schema.get("description", "") in text, (declaration.name, field)
