"""Spectra of the irregularities of a track and their realisations (constants.md 13)."""

import numpy as np
import pytest
from scipy.integrate import quad

from contact_models.vehicle.spectra import SPECTRA, Irregularities


@pytest.mark.parametrize(
    ("name", "longest", "rms"),
    [
        ("ERRI B176 low", 25.0, 0.714e-3),
        ("ERRI B176 low", 70.0, 1.393e-3),
        ("ERRI B176 low", 100.0, 1.695e-3),
        ("ERRI B176 high", 25.0, 1.213e-3),
        ("ERRI B176 high", 70.0, 2.369e-3),
        ("ERRI B176 high", 100.0, 2.881e-3),
    ],
)
def test_realisation_has_the_variance_of_its_band(name, longest, rms):
    """constants.md 13.1, rms of the alignment for wavelengths of 3 m to `longest`."""
    waves = Irregularities(spectrum=name, longest=longest).realise((3,))
    assert np.sqrt(0.5 * np.sum(waves.amplitude**2)) == pytest.approx(rms, abs=0.5e-6)


@pytest.mark.parametrize(
    ("channel", "name", "rms"),
    [
        ("vertical", "ERRI B176 low", 0.984e-3),
        ("vertical", "ERRI B176 high", 1.611e-3),
        ("cross_level", "ERRI B176 low", 0.91e-3),
        ("gauge", "ERRI B176 low", 0.25e-3),
    ],
)
def test_other_channels_have_the_variance_of_their_band(channel, name, rms):
    """constants.md 13.1, wavelengths of 3 m to 25 m: vertical and gauge [m], cross-level [rad]."""
    waves = Irregularities(spectrum=name, longest=25.0).realise((3,), channel)
    assert np.sqrt(0.5 * np.sum(waves.amplitude**2)) == pytest.approx(rms, rel=0.01)


@pytest.mark.parametrize(("channel", "name"), [(channel, name) for channel, names in SPECTRA.items() for name in names])
def test_closed_integral_is_that_of_the_density(channel, name):
    spectrum, low, high = SPECTRA[channel][name], 2.0 * np.pi / 100.0, 2.0 * np.pi / 3.0
    integral, _ = quad(lambda w: float(spectrum.density(np.array(w))), low, high, epsrel=1e-11, epsabs=0.0)
    assert float(spectrum.variance(np.array(low), np.array(high))) == pytest.approx(integral, rel=1e-9)


def test_german_spectrum_equals_simpacks_polynomial():
    """constants.md 13.1: b0/(a0 + a2 Ω² + Ω⁴) with the published coefficients, all digits."""
    w = np.geomspace(0.01, 3.0, 30)
    polynomial = 1.440846e-7 / (2.8855e-4 + 0.6803895 * w**2 + w**4)
    assert SPECTRA["alignment"]["ERRI B176 low"].density(w) == pytest.approx(polynomial, rel=2e-5)


def test_variance_along_a_long_track_is_that_of_the_waves():
    waves = Irregularities(spectrum="ERRI B176 low", longest=25.0).realise((5,))
    y, slope = np.array([waves.at(s) for s in np.arange(0.0, 20000.0, 0.9)]).T
    assert np.mean(y**2) == pytest.approx(0.5 * np.sum(waves.amplitude**2), rel=0.03)
    assert np.mean(slope**2) == pytest.approx(0.5 * np.sum((waves.amplitude * waves.wavenumber) ** 2), rel=0.03)


def test_slope_is_the_derivative():
    waves = Irregularities(spectrum="FRA 5").realise((1,))
    h = 1e-4
    assert waves.at(12.0)[1] == pytest.approx((waves.at(12.0 + h)[0] - waves.at(12.0 - h)[0]) / (2.0 * h), rel=1e-6)


def test_seed_decides_everything():
    one, same, other = (Irregularities(spectrum="ERRI B176 low").realise(seed) for seed in ((7, 1), (7, 1), (7, 2)))
    assert (one.phase == same.phase).all()
    assert (one.wavenumber == same.wavenumber).all()
    assert one.at(100.0) == same.at(100.0)
    assert one.at(100.0) != other.at(100.0)


def test_values_and_slopes_along_a_track_are_those_of_single_places():
    waves = Irregularities(spectrum="FRA 6").realise((2,), "gauge")
    s = np.array([0.0, 3.3, 71.0])
    assert pytest.approx(np.array([waves.at(place) for place in s]), rel=1e-9) == waves.over(s).T
