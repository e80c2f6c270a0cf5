"""The result of a run as an xarray dataset: time series, damage of wheels and rails, energies and provenance."""

from __future__ import annotations

import csv
import json
from dataclasses import asdict
from importlib.metadata import version
from os import PathLike
from pathlib import Path
from typing import Any

from contact.accumulation import Histogram, from_xarray, to_xarray
from contact.errors import ContactError
from contact.study.files import require_ending
from .run import BALANCE, VehicleRun

FORMAT = "wheelrail-contact run 1"
#: Endings of files with the time series.
ENDINGS = (".csv", ".mat", ".nc")


def dataset(run: VehicleRun) -> Any:
    """Return the result as an `xarray.Dataset`: time series over `distance`, and histograms of damage.

    The names of the histograms have prefixes like ``wheelset_1_right_wheel_``. The attributes contain the scenario, energies
    with the prefix ``balance_`` (`contact_models.runs.run.BALANCE`), measures of trust with the prefix ``trust_``
    (`contact_models.runs.trust.TRUST`), and the error of the step with the
    prefix ``step_error_`` (`contact_models.runs.trust.StepError`). The same scenario gives the same bytes at any time and
    on any machine.
    """
    import xarray

    scenario = run.scenario
    series = {
        name: ("distance", values, {"units": run.columns[name][0], "long_name": run.columns[name][1]})
        for name, values in run.series.items()
    }
    attributes = {
        "format": FORMAT,
        "source": f"wheelrail-contact {version('wheelrail-contact')}",
        "name": scenario.name,
        "scenario": repr(scenario.declared),
        "draw": json.dumps(scenario.draw),
        "fingerprint": scenario.fingerprint,
        "step": run.step,
        "without_damage": json.dumps(run.without_damage),
        "sections_without_damage": json.dumps(run.sections_without_damage),
        **{f"balance_{name}": value for name, value in run.balance.items()},
        **{f"trust_{name}": value for name, value in run.trust.as_dict().items()},
        **{f"step_error_{name}": value for name, value in asdict(run.step_error).items()},
        "warnings": " ".join(run.trust.warnings),
    }
    distance = series.pop("distance")
    whole = xarray.Dataset(series, {"distance": distance}, attributes)
    parts = [_named(to_xarray(histogram), _prefix(key)) for key, histogram in run.damage().items()]
    for part in parts:
        attributes |= part.attrs
    return xarray.merge([whole, *parts], combine_attrs="override", join="exact").assign_attrs(attributes)


def histogram(stored: Any, *key: str) -> Histogram:
    """Return one histogram of a result.

    Parameters
    ----------
    stored : xarray.Dataset
        Dataset from `dataset`, or read from its file.
    *key : str
        Name of the wheelset, "right" or "left", and "wheel" or "rail".

    Raises
    ------
    ContactError
        If `stored` is not the result of a run.
    """
    if stored.attrs.get("format") != FORMAT:
        raise ContactError(f"format = {stored.attrs.get('format')!r}: the dataset is not a {FORMAT}")
    prefix = _prefix(key)
    part = stored[[name for name in stored.variables if str(name).startswith(prefix)]]
    names = {name: str(name).removeprefix(prefix) for name in [*part.variables, *part.dims]}
    part = part.rename({name: new for name, new in names.items() if name in part.variables or name in part.dims})
    part.attrs = {name.removeprefix(prefix): value for name, value in stored.attrs.items() if name.startswith(prefix)}
    return from_xarray(part)


def write(whole: Any, path: str | PathLike[str]) -> None:
    """Write a dataset as NetCDF, version 3."""
    whole.to_netcdf(path, engine="scipy", format="NETCDF3_64BIT")


def write_series(run: VehicleRun, path: str | Path) -> None:
    """Write the time series of a run: .csv with a row for each sample, or .mat with the structs `series` and `units`.

    With the ending .nc the file is the whole `dataset`.

    Raises
    ------
    ContactError
        For another ending, or if the file cannot be written.
    """
    ending = require_ending(path, ENDINGS)
    series, units = run.series, {name: unit for name, (unit, _) in run.columns.items()}
    try:
        if ending == ".nc":
            write(dataset(run), path)
        elif ending == ".mat":
            from scipy.io import savemat

            savemat(path, {"series": series, "units": units}, long_field_names=True, oned_as="column")
        else:
            with open(path, "w", encoding="utf-8", newline="") as file:
                rows = csv.writer(file, lineterminator="\n")
                rows.writerow([f"{name} [{units[name]}]" for name in series])
                rows.writerows(zip(*(values.tolist() for values in series.values()), strict=True))
    except OSError as error:
        raise ContactError(f"{path} cannot be written: {error.strerror or error}") from None


def _prefix(key: tuple[str, ...]) -> str:
    return "".join(f"{part.replace(' ', '_')}_" for part in key)


def _named(part: Any, prefix: str) -> Any:
    """Return a dataset whose variables, dimensions and attributes have a prefix."""
    renamed = part.rename({name: f"{prefix}{name}" for name in {*part.variables, *part.dims}})
    renamed.attrs = {f"{prefix}{name}": value for name, value in part.attrs.items()}
    return renamed


__all__ = ["BALANCE", "ENDINGS", "FORMAT", "dataset", "histogram", "write", "write_series"]
