"""The table of creep forces: nodes, exact slopes, symmetry, smoothness, and errors between the nodes."""

import math

import numpy as np
import pytest

import contact
import reference
from contact.instance import workspace
from contact.kernels.tangential import table as kernel
from contact.study import creep_table
from contact.study.ellipse import ellipse
from contact.theory import force_table as table
from contact.theory import kalker
from reference import unseen

G, C, LIMIT, NU = 82e9, 6e-3, 24600.0, table.NU


def lookup(log_aspect, X, Y, Z):
    """Return Fx/(mu N), Fy/(mu N), Mz/(mu N c) and the share of slip, for forces of the linear theory over mu N."""
    coefficients = kalker.coefficients(kalker.table(NU), log_aspect)
    c11, c22, c23, _ = coefficients
    unit = LIMIT / (G * C * C)
    creepage = X * unit / c11, Y * unit / c22, Z * unit / (c23 * C)
    found = kernel.lookup(creepage, G, C, log_aspect, coefficients, LIMIT, table.load())
    return np.array(found) / (LIMIT, LIMIT, LIMIT * C, 1.0)


def test_the_nodes_are_the_rows_of_the_file():
    numbers = np.loadtxt(table.FILE, delimiter=",")
    log_aspect, alpha, beta, rho = table.nodes()
    for n in range(0, len(numbers), 23):
        i, j, k = table.rows()[n]
        for m, share in enumerate(rho[1:-1]):
            creepage = creep_table.creepage(log_aspect[i], alpha[j], beta[k], share)
            coefficients = kalker.coefficients(kalker.table(NU), log_aspect[i])
            scale = 0.3 * 82e3
            Fx, Fy, Mz, slip = kernel.lookup(
                (creepage.longitudinal, creepage.lateral, creepage.spin),
                G,
                C,
                log_aspect[i],
                coefficients,
                scale,
                table.load(),
            )
            found = (Fx / scale, Fy / scale, Mz / (scale * C), slip)
            np.testing.assert_allclose(found, numbers[n, 4 * m : 4 * m + 4], atol=1e-4)


@pytest.mark.parametrize("log_aspect", [-3.0, -1.1, 0.0, 0.4, 2.0, 3.5])
def test_slopes_at_zero_are_kalkers_exactly(log_aspect):
    _, c22, c23, c33 = kalker.coefficients(kalker.table(NU), log_aspect)
    tiny = 1e-6
    for X, Y, Z in np.vstack([np.eye(3), [[0.5, -0.6, 0.4]]]):
        Fx, Fy, Mz, slip = lookup(log_aspect, tiny * X, tiny * Y, tiny * Z)
        wanted = np.array([-X, -(Y + Z), c23 / c22 * Y - c33 / c23 * Z])
        np.testing.assert_allclose(np.array([Fx, Fy, Mz]) / tiny, wanted, atol=1e-4 * np.abs(wanted).max())
        assert 0.0 <= slip < 1e-3


def test_symmetries_hold_to_round_off():
    """Both symmetry operations of theory.md 2.6."""
    for X, Y, Z in np.random.default_rng(2).normal(0.0, 1.5, (50, 3)):
        one = lookup(0.3, X, Y, Z)
        np.testing.assert_allclose(lookup(0.3, -X, -Y, -Z), one * (-1, -1, -1, 1), atol=1e-14)
        np.testing.assert_allclose(lookup(0.3, X, -Y, -Z), one * (1, -1, -1, 1), atol=1e-14)


def test_forces_and_their_slopes_are_continuous():
    """Along lines across many cells and symmetry planes, second differences shrink with the square of the step.

    The slope may change where the limit mu N begins.
    """
    rng = np.random.default_rng(3)
    for start, way in zip(rng.normal(0, 1, (6, 3)), rng.normal(0, 2, (6, 3)), strict=True):
        roughness = []
        for n in (2000, 4000):
            curve = np.array([lookup(0.2 + 0.5 * u, *(start + u * way))[:3] for u in np.linspace(-1.0, 1.0, n)])
            below = np.hypot(curve[1:-1, 0], curve[1:-1, 1]) < 0.995
            roughness.append(np.abs(np.diff(curve, 2, axis=0))[below].max())
        assert roughness[1] < 0.3 * roughness[0]


def test_large_creepage_gives_full_slip():
    c11, c22, *_ = kalker.coefficients(kalker.table(NU), 0.1)
    found = lookup(0.1, 3e3 * c11, 4e3 * c22, 0.0)
    np.testing.assert_allclose(found, (-0.6, -0.8, 0.0, 1.0), atol=0.01)
    assert math.hypot(*found[:2]) <= 1.0 + 1e-12


def test_slender_ellipses_have_the_force_of_120_elements_along_x():
    """With 60, which are longer than they are wide there, the table was .0036 off."""
    log_aspect, alpha, beta, rho = table.nodes()
    slip = creep_table.creepage(float(log_aspect[9]), float(alpha[2]), float(beta[15]), float(rho[10]))
    separation = ellipse(math.exp(log_aspect[9]), C, creep_table.LOAD, creep_table.MATERIAL)
    given = {"load": creep_table.LOAD, "friction": 0.3, "material": creep_table.MATERIAL, "normal": "hertz"}
    found = contact.solve(separation, slip, tangential="table", n_strips=100, **given)
    exact = contact.solve(separation, slip, tangential="halfspace", n_strips=60, n_elements=120, **given)
    assert math.hypot(found.Fx - exact.Fx, found.Fy - exact.Fy) < 0.0015 * 0.3 * creep_table.LOAD


@pytest.mark.slow
def test_errors_on_cases_between_the_nodes_are_small():
    """The reference is the half space with the same number of elements, so the errors are those of interpolation."""
    cases, true = reference.unseen_ellipses()
    errors = unseen.errors(cases, true)
    assert errors["force"].mean() < 0.0012
    assert np.percentile(errors["force"], 95) < 0.0045
    assert errors["force"].max() < 0.019
    assert errors["moment"].mean() < 0.002
    assert errors["slip"].mean() < 0.005


def test_the_file_is_read_when_it_is_asked_for():
    """By the default too, since its effective creepages are in the same array; not by the methods of the thesis."""
    batched = contact.methods().batched
    for name, method in batched.tangential.items():
        arrays = workspace.allocate(batched.normal["analyn"], method, 0.28, (4, 4, 4))
        shape = kernel.SHAPE if name in ("fastrip_mapped", "table") else (1,) * 5
        assert arrays.tables.creep.shape == shape, name


def test_a_wrong_file_is_refused(tmp_path):
    path = tmp_path / "table.csv"
    with pytest.raises(contact.ContactError, match="is not a table"):
        table.load(path)
    path.write_text("1,2,3\n")
    with pytest.raises(contact.ContactError, match="a table of creep forces has"):
        table.load(path)


def test_a_build_that_was_interrupted_goes_on(tmp_path, monkeypatch):
    """The result agrees with the table of the package within the resolution."""
    rows = table.rows()
    monkeypatch.setattr(table, "rows", lambda: rows[300:302])
    whole, path, told = tmp_path / "whole.csv", tmp_path / "table.csv", []
    creep_table.build(whole, 20, processes=1, progress=lambda share, what: told.append(share))
    assert told == [0.5, 1.0]
    text = whole.read_text()
    path.write_text(text[: text.rstrip().rindex("\n") + 20])  # within the second row
    creep_table.build(path, 20, processes=1, progress=lambda share, what: told.append(share))
    assert path.read_text() == text
    assert told == [0.5, 1.0, 1.0]
    np.testing.assert_allclose(
        np.loadtxt(path, delimiter=","), np.loadtxt(table.FILE, delimiter=",")[300:302], atol=0.06
    )
    path.write_text("something else\n")
    with pytest.raises(contact.ContactError, match="does not contain the beginning of this table"):
        creep_table.build(path, 20, processes=1)


def test_the_command_builds_a_table(tmp_path, monkeypatch):
    pytest.importorskip("typer")
    from typer.testing import CliRunner

    from contact.cli.app import app

    rows = table.rows()
    monkeypatch.setattr(table, "rows", lambda: rows[300:301])
    path = tmp_path / "table.csv"
    result = CliRunner().invoke(app, ["table", "build", "--out", str(path), "--elements", "12", "--processes", "1"])
    assert result.exit_code == 0, result.output
    assert np.loadtxt(path, delimiter=",").shape == (60,)
