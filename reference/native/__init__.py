"""Compile the C hosts in the folder `host` for a platform and run them with a native FMU."""

import hashlib
import os
import shutil
import subprocess
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import fmpy

from contact.compile.linking import OF_WINDOWS, WITHOUT_MINGW, compiler, run
from contact.core import checkout
from contact.inputs.options import N_ELEMENTS, N_STRIPS
from contact.kernels.records import MAX_PATCHES
from contact_fmu.catalogue import models, vehicles
from contact_fmu.native import systems
from contact_fmu.native.component import Component
from contact_fmu.native.headers import HEADERS
from contact_fmu.tables.wheel_rail_contact import POINTS
from reference.native import source

ROOT = Path(__file__).parents[2]
NAME = "WheelRailContact"
HOST = Path(__file__).with_name("host")
_FMI2 = ("fmi2.c", "calls.c", "runs.c", "speed.c")
_FMI3 = ("fmi3.c", "calls_fmi3.c")
#: Platform name in a version of FMI → platform name of the builder, and sources of the host.
PLATFORMS = {
    "linux64": ("linux64", _FMI2),
    "win64": ("win64", _FMI2),
    "x86_64-linux": ("linux64", _FMI3),
    "x86_64-windows": ("win64", _FMI3),
}
SUFFIX = {"linux64": ("so", ""), "win64": ("dll", ".exe")}
#: FMU → variables that the hosts use, by role: inputs that are set, an input that must refuse NaN and its valid value, the
#: first output, two results that differ between instances, two integer choices, the coarsest resolution.
ROLES = {
    NAME: {
        "LOAD": "load.normal_force", "VARIED": "creepage.longitudinal", "REFUSED": "speed", "TAKEN": 20.0,
        "RESULT": "force.x", "SUM": "total.energy", "LATE": "creep_stiffness",
        "CHOICE": "method.normal", "OTHER_CHOICE": "method.tangential",
        "COARSEST": {"resolution.n_strips": 4, "resolution.n_elements": 4},
    },
    "WheelRailPair": {
        "LOAD": "load.normal_force", "VARIED": "velocity.y", "REFUSED": "velocity.x", "TAKEN": 20.0,
        "RESULT": "force.x", "SUM": "total.energy", "LATE": "moment.z",
        "CHOICE": "method.normal", "OTHER_CHOICE": "method.tangential",
        "COARSEST": {"resolution.n_strips": 4, "resolution.n_elements": 4, "resolution.n_samples": 5},
    },
}  # fmt: skip
#: The same for FMUs that meet wrong calls only.
ATTACKED = {
    "EllipticContact": ROLES[NAME],
    "Vehicle": {
        "LOAD": "friction.coefficient", "VARIED": "speed", "REFUSED": "speed", "TAKEN": 15.0,
        "RESULT": "distance", "SUM": "energy.dissipated", "LATE": "energy.residual",
        "CHOICE": "method.normal", "OTHER_CHOICE": "method.tangential",
        "COARSEST": {"resolution.n_strips": 4, "resolution.n_elements": 4},
    },
    "OpenVehicle": {
        "LOAD": "friction.coefficient", "VARIED": "speed", "REFUSED": "speed", "TAKEN": 15.0,
        "RESULT": "distance", "SUM": "distance", "LATE": "distance",
        "CHOICE": "distance", "OTHER_CHOICE": "distance", "COARSEST": {"distance": 0},
    },
}  # fmt: skip
ATTACKED["Wheelset"] = ATTACKED["OpenVehicle"]
SCENARIO = ROOT / "examples" / "scenarios" / "vehicle_300.toml"


#: A compiler that ends a program at a wrong access to memory, a leak or undefined behaviour.
SANITIZED = ("gcc", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-fno-omit-frame-pointer")


class Host:
    """Compiled host for one platform and one version of FMI. `compile_by` is a command instead of the usual compiler."""

    def __init__(
        self, platform: str, folder: Path, unzipped: Path, name: str = NAME, compile_by: Sequence[str] = ()
    ) -> None:
        system, code = PLATFORMS[platform]
        self.compiler = list(compile_by) or compiler(system)
        suffix, program = SUFFIX[system]
        self.guid = fmpy.read_model_description(str(unzipped)).guid
        self.library = unzipped / "binaries" / platform / f"{name}.{suffix}"
        self.resources = resources_of(unzipped, system)
        every = models(POINTS, accumulation=True) if name in ROLES else (*models(POINTS), *vehicles(SCENARIO))
        (model,) = (model for model in every if model.table.name == name)
        its = model.component
        (folder / "model.h").write_text(source.header(its, self.guid))
        (folder / "roles.h").write_text(roles(its))
        self.program = folder / f"host{program}"
        elements = MAX_PATCHES * N_STRIPS.usual * N_ELEMENTS.usual
        flags = ["-std=gnu11", "-O1", f"-DELEMENTS={elements}", f"-I{folder}", f"-I{HEADERS}"]
        flags += ["-DCONTACT"] if name == NAME else []
        sources = [HOST / name for name in ("common.c", *code)]
        compile_program([*self.compiler, *flags], system, sources, self.program)
        self.fmi2 = code is _FMI2
        self.prefix = [] if system == "linux64" else ["wine"]
        self.environment = os.environ | {"WINEDEBUG": "-all"}

    def __call__(self, command: str, *arguments: object, before: tuple[str, ...] = ()) -> str:
        """Run a command of the host and return its output. The first argument is a number."""
        given = (self.library, self.guid, self.resources if self.fmi2 else path_of(self.resources))
        words = [*before, *self.prefix, self.program, *given, command, *(arguments or (0,))]
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=3000, env=self.environment)
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
        return done.stdout

    def wrong_calls(self, folder: Path, trials: int) -> str:
        """Call every function of both versions of FMI wrongly, each time in a process of its own. Return what was done."""
        return self._program("wrong", folder, trials)

    def hardships(self, folder: Path) -> str:
        """Let every allocation fail once, run on a small stack, fork, and load the library again. Return what was done."""
        return self._program("hard", folder)

    def _program(self, name: str, folder: Path, *words: object) -> str:
        """Compile a host of both versions of FMI, run it and return its output."""
        program = folder / name
        flags = ["-std=gnu11", "-O1", "-rdynamic", f"-I{self.program.parent}", f"-I{HEADERS}"]
        run(*self.compiler, *flags, HOST / "common.c", HOST / f"{name}.c", "-o", program, "-ldl", "-lpthread", "-lm")
        given = [program, self.library, self.guid, self.resources, path_of(self.resources), *words]
        done = subprocess.run(list(map(str, given)), capture_output=True, text=True, timeout=3000)
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
        return done.stdout


def compile_program(command: Sequence[str], platform: str, sources: Sequence[Path], program: Path) -> None:
    """Compile a host for a platform of the builder: "linux64" or "win64". `command` is the compiler with its options.

    Windows hosts are linked like the FMU's libraries, without mingw's start-up code, which takes zig a minute to build.
    """
    if platform != "win64":
        run(*command, *sources, "-o", program, "-ldl", "-lpthread", "-lm")
        return
    made = []
    for path in (*sources, HOST / "start_of_windows.c", OF_WINDOWS):
        made.append(program.parent / f"{path.stem}.o")
        run(*command, "-c", path, "-o", made[-1])
    run(*command, *made, "-o", program, *WITHOUT_MINGW, "-lapi-ms-win-crt-time-l1-1-0", "-Wl,--entry,mainCRTStartup")


def compile_once(by: Sequence[str], words: Sequence[object], sources: Path, made: Path) -> None:
    """Make `made` of the C files in `sources` by a compiler, or copy what it has made of the same ones before.

    It is kept beside the kernels, in a file whose name is a hash of compiler, words and files: kernels in C take a minute.
    """
    tool = version("ziglang").encode() + subprocess.run([by[0], "--version"], capture_output=True).stdout
    content = hashlib.sha256(tool + " ".join(map(str, (*by, *words))).replace(str(sources), "").encode())
    for path in sorted(sources.iterdir()):
        content.update(f"{path.name}\0".encode() + path.read_bytes())
    kept = systems.kernels() / f"of-c-{content.hexdigest()[:16]}"
    with checkout.locked(kept):
        if not kept.is_file():
            run(*by, *words, "-o", made)
            shutil.copy(made, kept.with_suffix(".part")).rename(kept)
    shutil.copy(kept, made)


def sanitized(folder: Path, unzipped: Path, name: str) -> Host:
    """Return a host for Linux, and the FMU compiled from its sources, kernels included, both with sanitizers."""
    # two instances for each thread: with sanitizers 64 of them take half a minute
    host = Host("linux64", folder, unzipped, name, (*SANITIZED, "-DN_INSTANCES=16"))
    host.library = folder / "sanitized.so"
    flags = ("-std=c11", "-O0", "-ffp-contract=off", "-w", "-fPIC", "-shared", f"-I{unzipped / 'sources'}")
    # the sources write all names with that of the FMU, those of FMI only if a host asks for it
    sources = unzipped / "sources"
    compile_once(SANITIZED, (*flags, *sorted(sources.glob("*.c")), "-lm"), sources, host.library)
    return host


def resources_of(unzipped: Path, platform: str) -> str:
    """Return the URI of the resources of an unzipped FMU. Wine shows the files of Linux as drive Z."""
    uri = (unzipped / "resources").resolve().as_uri()
    return uri if platform == "linux64" else uri.replace("file:///", "file:///Z:/")


def path_of(resources: str) -> str:
    """Return the path of a folder for hosts of FMI 3.0, which get no URI."""
    path = unquote(urlsplit(resources).path)
    return path.removeprefix("/") if path.startswith("/Z:") else path


def roles(its: Component) -> str:
    """Return the text of roles.h for an FMU."""
    table = its.table
    given: dict[str, Any] = {**ROLES, **ATTACKED}[table.name]
    coarsest = given["COARSEST"]
    lines = [f"#define {role} {source.c_name(of)}" for role, of in given.items() if isinstance(of, str)]
    lines += [f'#define VARIED_NAME "{given["VARIED"]}"', f"#define TAKEN {given['TAKEN']}"]
    lines += [f"#define HAS_EXCHANGE {int(its.exchange)}"]
    lines += [f"#define RESOLUTION {{{', '.join(map(source.c_name, coarsest))}}}"]
    lines += [f"#define COARSEST {{{', '.join(map(str, coarsest.values()))}}}"]
    return "\n".join(lines) + "\n"


def kernel_objects() -> list[Path]:
    """Return the paths of the compiled kernels for Linux, which the build of the FMU keeps."""
    from contact.compile.objects import objects

    return objects(systems.kernels(), "linux64")


def kernel_library(folder: Path, cpu: str) -> Path:
    """Build a Linux library of the kernels for one processor (size, prepare, outputs) and return its path."""
    library = folder / f"kernels_{cpu}.so"
    code = Path(__file__).with_name("kernels.c")
    own = ", ".join(map(str, models(POINTS)[0].component.own))
    (folder / "own.h").write_text(f"static const int64_t own[] = {{{own}}};\n")
    run(
        *compiler("linux64"),
        "-shared",
        "-fPIC",
        f"-I{folder}",
        f"-DCPU={cpu}",
        code,
        *kernel_objects(),
        "-o",
        library,
        "-lm",
    )
    return library
