"""FMUs as a user gets them: built by the command and driven by fmpy."""

import os
import re
import shutil
from functools import cache
from pathlib import Path

import fmpy
import pytest
from contact_case import NAME
from fmu_instance import Instance, Instance3
from lark import Lark
from pair_case import NAME as PAIR

from reference.native import Host

ROOT = Path(__file__).parents[2]
VEHICLES = ("Vehicle", "OpenVehicle")


@pytest.fixture(scope="session", autouse=True)
def _one_name_of_every_kind():
    """Let fmpy's validation parse one name of those that differ in numbers only, which its grammar treats alike: 8 ms each."""
    parse, legal = Lark.parse, set()

    def once(parser: Lark, name: str) -> None:
        kind = re.sub(r"\d+", "1", name)
        if kind not in legal:
            parse(parser, name)
            legal.add(kind)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Lark, "parse", once)
        yield


@pytest.fixture(scope="session", autouse=True)
def _one_reading_of_every_description():
    """Let fmpy read a model description once as long as its file does not change: .1 s each, for more than 1000 instances."""
    read = fmpy.read_model_description
    kept = cache(lambda path, written, size, options: read(path, **dict(options)))

    def once(path: str, **options):
        file = Path(path) / "modelDescription.xml" if Path(path).is_dir() else Path(path)
        return kept(path, file.stat().st_mtime_ns, file.stat().st_size, tuple(options.items()))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fmpy, "read_model_description", once)
        yield


@pytest.fixture(scope="session")
def fmus(once) -> Path:
    """Return the folder with the FMUs that `python build_fmu.py --packaging python` builds."""
    return once("fmus") / "python"


@pytest.fixture(scope="session")
def native(once) -> Path:
    """Return the file of the native WheelRailContact, in one folder with the others."""
    return once("native") / "native" / "WheelRailContact.fmu"


@pytest.fixture(scope="session")
def native_vehicles(native) -> Path:
    """Return the folder with the native Vehicle, OpenVehicle and coupled_vehicle.ssp."""
    return native.parents[1] / "vehicles"


@pytest.fixture(scope="session")
def native_surfaces(native, once) -> list[Path]:
    """Return the files of WheelRailSurfaces of FMI 2.0 and 3.0, with profiles that are constant."""
    folder = once("native_surfaces")
    return [folder / "WheelRailSurfaces.fmu", folder / "fmi3" / "WheelRailSurfaces.fmu"]


@pytest.fixture(scope="session")
def unzipped(tmp_path_factory):
    """Return a function that gives the folder of an unzipped native FMU, one for all tests, which leave it as it is."""

    @cache
    def folder(path: Path) -> Path:
        place = tmp_path_factory.mktemp("unzipped") / "with blanks, ümläuts and 100 %"
        return Path(fmpy.extract(str(path), str(place)))

    return folder


@pytest.fixture(scope="session")
def native_folder(native, unzipped) -> Path:
    """Return the folder of the unzipped native WheelRailContact."""
    return unzipped(native)


@pytest.fixture(scope="session")
def native_fmi3(native) -> Path:
    """Return the file of the native WheelRailContact of FMI 3.0."""
    return native.parent / "fmi3" / native.name


@pytest.fixture(scope="session")
def native_fmi3_folder(native_fmi3, tmp_path_factory) -> Path:
    """Return the folder of the unzipped native WheelRailContact of FMI 3.0. Its path is plain: Wine passes it on as a word."""
    return Path(fmpy.extract(str(native_fmi3), str(tmp_path_factory.mktemp("unzipped"))))


@pytest.fixture(scope="session")
def native_wheelset(native) -> Path:
    """Return the file of the native Wheelset."""
    return native.with_name("Wheelset.fmu")


@pytest.fixture
def freed():
    """Return a function that returns an instance, which is freed at the end."""
    instances = []
    yield lambda instance: instances.append(instance) or instance
    for instance in instances:
        instance.free()


@pytest.fixture
def open_native(native_folder, freed):
    """Return a function that instantiates the native WheelRailContact."""
    return lambda kind="CoSimulation": freed(Instance(native_folder, kind=kind))


@pytest.fixture
def open_native_fmi3(native_fmi3_folder, freed):
    """Return a function that instantiates the native WheelRailContact of FMI 3.0."""
    return lambda kind="CoSimulation": freed(Instance3(native_fmi3_folder, kind=kind))


@pytest.fixture(scope="session")
def wine(once) -> None:
    """Let Wine use one folder of its own in all workers."""
    if not shutil.which("wine"):
        pytest.skip("THE WINDOWS LIBRARY IS NOT TESTED: wine is not installed (apt-get install wine64)")
    os.environ["WINEPREFIX"] = str(once("wine"))


@pytest.fixture(scope="session")
def hosts(request, native, unzipped, tmp_path_factory):
    """Return a function that gives the C host of a platform and an FMU, each compiled once. "win64" runs under Wine."""

    @cache
    def make(platform: str, name: str) -> Host:
        if platform == "win64":
            request.getfixturevalue("wine")
        place = request.getfixturevalue("native_vehicles") if name in VEHICLES else native.parent
        return Host(platform, tmp_path_factory.mktemp(platform), unzipped(place / f"{name}.fmu"), name)

    return make


@pytest.fixture(scope="session")
def host(hosts):
    """Return the C host of WheelRailContact on Linux."""
    return hosts("linux64", NAME)


@pytest.fixture(scope="session")
def host_fmi3(native_fmi3_folder, tmp_path_factory):
    """Return the C host for FMI 3.0 on Linux."""
    return Host("x86_64-linux", tmp_path_factory.mktemp("linux"), native_fmi3_folder)


@pytest.fixture(scope="session")
def windows_fmi3(native_fmi3_folder, tmp_path_factory, wine):
    """Return the C host for FMI 3.0 on Windows, under Wine."""
    return Host("x86_64-windows", tmp_path_factory.mktemp("windows"), native_fmi3_folder)


@pytest.fixture
def open_pair(native, unzipped, freed):
    """Return a function that instantiates the native WheelRailPair, or that of another file."""
    file = native.with_name(f"{PAIR}.fmu")
    return lambda kind="CoSimulation", path=file: freed(Instance(unzipped(path), kind=kind))


@pytest.fixture
def open_fmu(fmus, unzipped, freed):
    """Return a function that instantiates an FMU for hosts with Python by name, or that of another file."""
    return lambda name, path=None: freed(Instance(unzipped(path or fmus / f"{name}.fmu")))


@pytest.fixture
def opened(native, unzipped, freed):
    """Return a function that instantiates a native FMU by name."""
    return lambda name: freed(Instance(unzipped(native.with_name(f"{name}.fmu"))))
