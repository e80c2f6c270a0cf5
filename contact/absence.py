"""What a law that gives forces alone leaves out: reading it is an error that says so, instead of zeros."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from contact.errors import ContactError

Class = TypeVar("Class")


class _OnlyWithFields:
    """Attribute of a record that can be read only where its `has_fields` is true."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __get__(self, record: Any, owner: type | None = None) -> Any:
        if record is None:
            return self
        if not record.has_fields:
            raise ContactError(
                f"there is no {self.name}: tangential = {record.tangential!r} gives forces alone; contact.methods() lists "
                "the methods with fields"
            )
        if self.name not in record.__dict__:
            return record.__getattr__(self.name)
        return record.__dict__[self.name]

    def __set__(self, record: Any, value: Any) -> None:
        record.__dict__[self.name] = value


def only_with_fields(*names: str) -> Callable[[type[Class]], type[Class]]:
    """Make these attributes of a dataclass raise a ContactError where its `has_fields` is false."""

    def wrap(record: type[Class]) -> type[Class]:
        for name in names:
            setattr(record, name, _OnlyWithFields(name))
        return record

    return wrap
