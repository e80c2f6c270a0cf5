"""Groups of arrays in compiled code: a function gets the address of a group, not its hundreds of numbers.

Numba passes every number of a named tuple by itself; the arrays of a pair have 1400. Passed by address, the kernels are
half as much code. A group never changes after it was made, which the compiler is told. Inner groups lie inside the outer one.
Only a process that compiles imports this.
"""

from __future__ import annotations

from hashlib import blake2s
from inspect import signature
from typing import Any

from llvmlite import ir
from llvmlite.ir.instructions import ExtractValue
from numba import types
from numba.core import cgutils
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    infer_getattr,
    lower_builtin,
    lower_getattr_generic,
    models,
    register_model,
    type_callable,
    typeof_impl,
)

_WORD = ir.IntType(64)


class GroupClass(type):
    """Metaclass of groups, by which numba tells them from other named tuples."""


@typeof_impl.register(GroupClass)
def _typeof_class(value: GroupClass, context: Any) -> None:
    """Leave a group's class to what `passed_by_address` has said of it."""


class Group(types.Type):
    """Type of a group: its class, and the types of its members."""

    def __init__(self, instance_class: type, members: tuple[types.Type, ...]) -> None:
        self.instance_class, self.types = instance_class, members
        self.fields: tuple[str, ...] = instance_class._fields  # type: ignore[attr-defined]
        digest = blake2s(repr([member.name for member in members]).encode(), digest_size=6).hexdigest()
        super().__init__(name=f"{instance_class.__name__}_{digest}")  # short, since every symbol has it

    @property
    def key(self) -> Any:
        return self.instance_class, self.types


@register_model(Group)
class _Model(models.DataModel):
    """Address of a structure in compiled functions. It is returned as the structure itself."""

    def __init__(self, manager: Any, group: Group) -> None:
        super().__init__(manager, group)
        self.members = [manager.lookup(kind) for kind in group.types]
        self.structure = ir.LiteralStructType([_stored(member) for member in self.members])
        if self.structure != ir.LiteralStructType([member.get_data_type() for member in self.members]):
            raise TypeError(f"{group.fields} of {group.name} cannot lie side by side: a tuple of groups, or a bool")

    def get_value_type(self) -> Any:
        return self.structure.as_pointer()

    def get_data_type(self) -> Any:
        return self.structure

    get_return_type = get_data_type

    def as_argument(self, builder: Any, value: Any) -> Any:
        return value

    def from_argument(self, builder: Any, value: Any) -> Any:
        if isinstance(value, ir.Argument):
            for attribute in ("noalias", "captures(none)"):
                value.add_attribute(attribute)
        return value

    def as_data(self, builder: Any, value: Any) -> Any:
        return builder.load(value)

    def from_data(self, builder: Any, value: Any) -> Any:
        """Return the address of a structure that was loaded from where the called function has left it."""
        if isinstance(value, ExtractValue):
            return builder.gep(
                self.from_data(builder, value.aggregate), [_index(0), *map(_index, value.indices)], inbounds=True
            )
        return value.operands[0]

    as_return, from_return = as_data, from_data

    def read(self, builder: Any, value: Any, i: int) -> Any:
        """Return member number `i`."""
        place = builder.gep(value, [_index(0), _index(i)], inbounds=True)
        return place if isinstance(self.members[i], _Model) else builder.load(place)

    def write(self, builder: Any, values: Any) -> Any:
        """Return a new group. Its place is in the frame of the function, one for each call in the source."""
        group = cgutils.alloca_once(builder, self.structure)
        for i, (member, value) in enumerate(zip(self.members, values, strict=True)):
            place = builder.gep(group, [_index(0), _index(i)], inbounds=True)
            if isinstance(member, _Model):
                end = ir.Constant(value.type, None).gep([_index(1)])
                cgutils.raw_memcpy(builder, place, value, end.ptrtoint(_WORD), 1, align=8)
            else:
                builder.store(value, place)
        return group


def _stored(member: Any) -> Any:
    return member.structure if isinstance(member, _Model) else member.get_value_type()


def _index(i: int) -> Any:
    return ir.Constant(ir.IntType(32), i)


@infer_getattr
class _Members(AttributeTemplate):
    key = Group

    def generic_resolve(self, group: Group, name: str) -> types.Type | None:
        return group.types[group.fields.index(name)] if name in group.fields else None


@lower_getattr_generic(Group)
def _member(context: Any, builder: Any, group: Group, value: Any, name: str) -> Any:
    return context.data_model_manager[group].read(builder, value, group.fields.index(name))


def passed_by_address(named_tuple: type) -> type:
    """Return the class of named tuples as one whose instances compiled functions pass by address."""
    kept = ("__module__", "__qualname__", "__doc__", "__orig_bases__")
    namespace = {name: value for name, value in vars(named_tuple).items() if name in kept}
    group = GroupClass(named_tuple.__name__, (named_tuple,), {**namespace, "__slots__": ()})
    arguments = signature(named_tuple)

    @type_callable(group)
    def _typing(context: Any) -> Any:
        def typer(*given: Any, **named: Any) -> Group:
            return Group(group, arguments.bind(*given, **named).args)

        typer.pysig = arguments  # type: ignore[attr-defined]
        return typer

    @lower_builtin(group, types.VarArg(types.Any))
    def _make(context: Any, builder: Any, made: Any, values: Any) -> Any:
        return context.data_model_manager[made.return_type].write(builder, values)

    return group
