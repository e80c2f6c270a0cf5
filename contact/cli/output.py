"""Writing of result files, and early exit of a command with a message."""

from __future__ import annotations

import errno
import functools
import inspect
import re
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import typer
from rich.console import Console
from typer.models import OptionInfo

from contact.cli.document import document, running
from contact.cli.extras import EXTRAS, absent_modules
from contact.cli.groups import expanded
from contact.errors import ContactError, ModelWarning, PlausibilityWarning
from contact.results import Status
from contact.study.files import PICTURES, csv_of, require_writable, write

#: Last parts of names in messages of the library → the options that set them, where no word of the option is in the name.
_OPTIONS = {"approach": "penetration", "distance": "step", "forward": "speed"}
_NAMED = re.compile(r"\b([A-Za-z][\w.]*)(?:\[\d+\])? = ('[^']*'|\([^()]*\)|True|[-+.\de]*\d|nan|-?inf)")
#: Other words in messages of the library → those of the command line.
_WORDS = (
    (r"\brepair=True", "--profile-repair"),
    (r"\b(rows|columns)=\((\w+), (\w+)\)", r"--profile-\1 \2 \3"),
    (r"\b(zero|smoothing|wavelength)='?([\w.+-]+)'?", r"--profile-\1 \2"),
    (r"\brotated\((\S+)\) turns the wheel", r"--profile-rotation \1 0 turns the wheel"),
    (r"\brotated\((\S+)\) turns the rail", r"--profile-rotation 0 \1 turns the rail"),
    (r"\b(kind|unit|side) = None(?=[:,])", r"--profile-\1"),
    (r"\bset (unit|side|section)\b", r"set --profile-\1"),
    (r" \(throw=False [^)]*\)", ""),
    ("of the given separation; extend y", "of a profile"),
)
#: Exit status of a command, besides 0.
MISSING, BAD_INPUT, NOT_TRUSTED, INTERRUPTED = 1, 2, 3, 130
_OWN = PlausibilityWarning, ModelWarning
Command = TypeVar("Command", bound=Callable[..., None])


def reported(command: Command) -> Command:
    """Return the command with its groups of options, and with errors and warnings as messages on stderr.

    The exit status is `BAD_INPUT` for these errors and `MISSING` for a missing extra.
    """
    command = expanded(command)
    name, flags = command.__name__.removeprefix("list_"), _flags(command)

    @functools.wraps(command)
    def wrapper(*args: Any, **kwargs: Any) -> None:
        given = {option: kwargs[name] for name, (option, _) in flags.items() if kwargs.get(name) is not None}
        typed = [option for option, usual in flags.values() if option in given and given[option] != usual]
        try:
            with warnings.catch_warnings(), running(name, kwargs, given):
                for kind in _OWN:
                    warnings.simplefilter("default", kind)  # once, though both wheels have the same load
                warnings.showwarning = _teller(given)
                _require_apart(kwargs)
                command(*args, **kwargs)
        except ContactError as error:
            stop(in_options(str(error), given, typed), BAD_INPUT)
        except OSError as error:
            if error.errno == errno.EPIPE:  # the reader of a pipe has had enough, as in `contact profiles | head`
                raise
            stop(f"{error.filename}: {error.strerror}" if error.filename else str(error), BAD_INPUT)
        except ImportError as error:
            if "pip install 'wheelrail-contact[" not in str(error):
                raise
            stop(str(error), MISSING)

    return wrapper  # type: ignore[return-value]


def _require_apart(inputs: Mapping[str, Any]) -> None:
    """Refuse, before the computation, to write over a file that the command reads."""

    def files(value: Any) -> set[Path]:
        parts = value if isinstance(value, list) else [value]
        return {Path(one).resolve() for one in parts if isinstance(one, str | Path) and Path(one).is_file()}

    if written := files(inputs.get("out")):
        for both in written.intersection(
            set().union(*(files(value) for name, value in inputs.items() if name != "out"))
        ):
            raise ContactError(f"{both} cannot be written: the command reads it")


def in_options(text: str, given: Mapping[str, Any], refused: Collection[str] = ()) -> str:
    """Return a message with the options of the command line in place of names of Python.

    `given` are the command's options with their values. If one of some options is `refused`, its value alone may tell which.
    """
    for words, option in _WORDS:
        text = re.sub(words, option, text)
    return _NAMED.sub(lambda found: _typed(found, given, refused), text)


def _typed(found: re.Match[str], given: Mapping[str, Any], refused: Collection[str]) -> str:
    """Return ``--radius 460`` for ``nominal_radius = 460`` if that is the option's value."""
    name, value = found[1], found[2]
    words = {*re.split(r"[._]", name), _OPTIONS.get(name.split(".")[-1])}
    holders = {o: set(o.lstrip("-").split("-")) for o, one in given.items() if value in _shown(one)}
    named = sorted((o for o in holders if words & holders[o]), key=lambda o: len(holders[o] - words))
    if not named:
        named = [o for o in holders if o in refused]
        if len(named) != 1:
            return found[0]
    option = named[0]
    if value not in _shown(given[option], inside=False):
        return f"{option}: {found[0]}"
    return option if value == "True" else f"{option} {value}"


def _shown(value: Any, *, inside: bool = True) -> set[str]:
    """Return how messages may show a value, or one of those in it."""
    parts = value if inside and isinstance(value, tuple | list) else ()
    shown = f"{value:g}" if isinstance(value, int | float) and not isinstance(value, bool) else str(value)
    return {shown, repr(shown), repr(value)}.union(*map(_shown, parts))


def _flags(command: Callable[..., None]) -> dict[str, tuple[str, Any]]:
    """Return the option and the default of each parameter of a command. Typer takes the first option as `default`."""
    found = {}
    for name, one in inspect.signature(command).parameters.items():
        about = getattr(one.annotation, "__metadata__", [None])[0]
        if isinstance(about, OptionInfo):
            words = [about.default, *(about.param_decls or ()), f"--{name.replace('_', '-')}"]
            found[name] = next(str(word) for word in words if str(word).startswith("--")), one.default
    return found


def _teller(given: Mapping[str, Any]) -> Callable[..., None]:
    """Return a function in place of `warnings.showwarning` that prints each warning on one line, and each line once."""
    said: set[str] = set()

    def say(message: Warning | str, category: type[Warning], *place: Any) -> None:
        kind = "warning" if issubclass(category, _OWN) else category.__name__
        line = f"contact: {kind}: {in_options(str(message), given)}"
        if line not in said:
            said.add(line)
            typer.echo(line, err=True)

    return say


def drawing() -> Any:
    """Return `contact.plot`. If matplotlib is missing, exit with a message that names the extra."""
    try:
        from contact import plot
    except ImportError as error:
        stop(str(error), MISSING)
    return plot


def require_extra(extra: str) -> None:
    """Exit with a message if an extra is not installed."""
    if absent := absent_modules(extra):
        names = f"{' and '.join(absent)} {'is' if len(absent) == 1 else 'are'} missing"
        stop(f"{names} ({EXTRAS[extra][1]}): pip install 'wheelrail-contact[{extra}]'", MISSING)


def deliver(
    content: Mapping[str, Any],
    *,
    show: Callable[[Console], None],
    as_json: bool = False,
    out: Sequence[Path] | None = None,
    rows: Callable[[], Sequence[Mapping[str, Any]]] | None = None,
    figure: Callable[[], Any] | None = None,
) -> None:
    """Print results, or their JSON, and write them to each of the files `out`: JSON, rows as CSV, or the figure."""
    text = document(content) if as_json or any(path.suffix.lower() == ".json" for path in out or []) else ""
    if as_json:
        typer.echo(text)
    else:
        show(Console())
    texts: dict[str, Callable[[], str]] = {".json": lambda: f"{text}\n"}
    if rows is not None:
        texts[".csv"] = lambda: csv_of(rows())
    for path in out or []:
        write(path, texts, figure)
        typer.echo(f"wrote {path}", err=True)


def prepare(out: Sequence[Path] | None, texts: Sequence[str] = (".csv", ".json")) -> None:
    """Refuse, before the computation, files that cannot be written, and pictures if matplotlib is missing."""
    endings = {require_writable(path, (*texts, *PICTURES)) for path in out or []}
    if endings.intersection(PICTURES):
        drawing()


def write_all(found: Any, paths: Sequence[Path]) -> None:
    """Write the results of a study to each of the paths."""
    for path in paths:
        try:
            found.write(path)
        except ImportError as error:
            stop(str(error), MISSING)
        typer.echo(f"wrote {path}", err=True)


def require_trusted(statuses: Sequence[float], what: str) -> None:
    """End the command with `NOT_TRUSTED` if one of the results, which are `what`, has no trustworthy status."""
    doubtful = [Status(int(one)) for one in statuses if one > Status.SATURATED]
    if doubtful:
        names = ", ".join(sorted({one.name.lower().replace("_", " ") for one in doubtful}))
        stop(f"{len(doubtful)} of {len(statuses)} {what} are not to be trusted: {names}", NOT_TRUSTED)


def stop(message: str, code: int) -> NoReturn:
    typer.echo(f"contact: {message}", err=True)
    raise typer.Exit(code)
