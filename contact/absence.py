"""Attributes that exist only if the tangential method computes fields. Reading a missing one raises a ContactError."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from contact.errors import ContactError

Class = TypeVar("Class")


class _OnlyWithFields:
    """Descriptor of an attribute that can be read only if the record's `has_fields` is true."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __get__(self, record: Any, owner: type | None = None) -> Any:
        if record is None:
            return self
        if not record.has_fields:
            raise ContactError(
                f"there is no {self.name}: tangential = {record.tangential!r} gives forces only; contact.methods() lists "
                "the methods with fields"
            )
        if self.name not in record.__dict__:
            return record.__getattr__(self.name)
        return record.__dict__[self.name]

    def __set__(self, record: Any, value: Any) -> None:
        record.__dict__[self.name] = value


def only_with_fields(*names: str) -> Callable[[type[Class]], type[Class]]:
    """Return a class decorator: these attributes raise a ContactError if the record's `has_fields` is false."""

    def wrap(record: type[Class]) -> type[Class]:
        for name in names:
            setattr(record, name, _OnlyWithFields(name))
        return record

    return wrap
