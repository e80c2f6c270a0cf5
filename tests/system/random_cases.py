"""Random contacts, with the solver's own results."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from contact_case import CREEPAGES
from fmu_instance import named

import contact
from contact.damage import evaluate
from contact.friction import LAWS, VELOCITIES, Friction
from contact.inputs.material import Thermal

METHODS = contact.methods().batched
#: Outputs after one step of STEP, without the creep stiffness.
OUTPUTS = (
    *("force.x", "force.y", "force.n", "moment.z", "approach", "pressure.max", "patch.area", "patch.length"),
    *("patch.width", "slip.ratio", "power.friction", "damage.T_gamma", "damage.wear_rate_pearce_sherratt"),
    *("damage.index_burstow", "damage.wear_rate_usfd", "damage.archard_depth_max", "damage.archard_volume"),
    *("damage.fatigue_index_surface", "damage.stress_index_max", "damage.energy_index_max", "stiffness.normal"),
    *("total.energy", "total.worn_volume", "gap_error", "bend", "beyond", "patch.count", "status"),
)
#: Parameters of temperature-dependent friction.
HEAT = (
    *("friction.hot_factor", "friction.reference_temperature", "friction.temperature_range"),
    *("friction.background_temperature", "thermal.conductivity", "thermal.density", "thermal.heat_capacity"),
    "thermal.heat_share",
)
STEP = 1e-3
POINTS = 41


@dataclass(frozen=True)
class Case:
    """Values of the FMU by name (an int for an Integer or Enumeration), and the solver's result for the same problem."""

    seed: int
    values: dict[str, float]
    solution: contact.Solution

    def expected(self) -> np.ndarray:
        """OUTPUTS by the solver."""
        s = self.solution
        d = evaluate(s, self.values["wheel.radius"])
        power = s.speed * s.power_per_metre
        local = (0.0,) * 4
        if d.has_fields:
            local = d.archard.depth_max, d.archard.volume, d.stress_index.max, d.energy_index.max
        depth, volume, stress, energy = local
        bend = s.bend if self.values["geometry.surface"] == 2 else 0.0  # a plane contact has no angles
        return np.array(
            [
                *(s.Fx, s.Fy, s.N, s.Mz, s.approach, s.max_pressure, s.area, s.length, s.width, s.slip_ratio, power),
                *(d.T_gamma, d.pearce_sherratt, d.burstow, d.usfd, depth, volume),
                *(d.fatigue_index, stress, energy, s.normal_stiffness),
                *(STEP * power, STEP * s.speed * volume, s.gap_error, bend, s.beyond, s.n_patches, s.status),
            ]
        )

    def differences(self, actual: np.ndarray) -> np.ndarray:
        """Return the differences of OUTPUTS from the solver's, relative to the scale of each output.

        The scale is the value, with these exceptions. It is mu N for forces. It is multiplied by mu N over the force for
        results that are computed from forces. It is mu N times 2 cm for the moment, the yield stress for the stress index
        (a difference from it), and 1 for slip, fatigue index, `gap_error` and `bend`. The stiffness of most methods is a
        difference quotient over a millionth of the approach, so its scale is larger by 1000. With a pressure limit the
        iteration of interacting strips magnifies the last digit of asin, so the scale is larger by 10.
        """
        wanted, s = self.expected(), self.solution
        limit, force = s.friction * s.N, s.used_friction * s.N
        scale = dict(zip(OUTPUTS, np.abs(wanted), strict=True))
        for name in scale:
            if name.startswith("damage") and force > 0.0:
                scale[name] *= limit / force
        # the pressure on a tilted surface has a part in the lateral force
        lateral = np.hypot(limit, s.N) if abs(s.Fy) > limit else limit
        scale |= {"force.x": limit, "force.y": lateral, "moment.z": 0.02 * lateral, "slip.ratio": 1.0}
        scale |= {"damage.stress_index_max": s.material.shear_yield, "damage.fatigue_index_surface": 1.0}
        scale |= {"gap_error": 1.0, "bend": 1.0, "beyond": 1.0}
        scale["stiffness.normal"] *= 1e3
        digits = 10.0 if s.normal == "strip_halfspace" and s.material.pressure_limit < math.inf else 1.0
        return np.abs(actual - wanted) / (digits * np.array(list(scale.values())) + 1e-300)


def random_case(seed: int) -> Case:
    """Return a random case of any method, friction law, geometry and load.

    Some cases have lift-off, no friction, vanishing or large creepage.
    """
    rng = np.random.default_rng(seed)
    y0, dy = rng.uniform(-0.022, -0.018), rng.uniform(0.9e-3, 1.1e-3)
    y = y0 + dy * np.arange(POINTS)
    centre, B = rng.uniform(-8e-3, 8e-3), 10 ** rng.uniform(-0.3, 1.7)
    skew, wave = rng.uniform(-20, 20), rng.uniform(-1, 1)
    g = B * (y - centre) ** 2 * (1.0 + skew * (y - centre)) + 2e-6 * wave * np.cos(900.0 * y) + rng.uniform(-1e-5, 1e-5)
    A = rng.uniform(0.8, 1.6) + rng.uniform(-8.0, 8.0) * y
    curvatures, by_load = rng.random() < 0.2, rng.random() < 0.7
    load, approach = 10 ** rng.uniform(3.5, 5.2), rng.uniform(-2e-5, 2e-4)
    creepages = 10 ** np.array([*rng.uniform(-5, -1.7, 2), rng.uniform(-3, 0.5)]) * rng.choice([-1, 1], 3)
    G, nu, H, k = rng.uniform(70e9, 90e9), rng.uniform(0.0, 0.5), rng.uniform(2e9, 4e9), rng.uniform(2e8, 4e8)
    mu, speed, radius = rng.uniform(0.0, 0.6), rng.uniform(1.0, 80.0), rng.uniform(0.3, 0.6)
    normal, tangential = (int(rng.integers(len(methods))) for methods in METHODS)
    n_strips, n_elements = (int(n) for n in rng.integers(6, 40, 2))
    rare = rng.random(4) < 0.05
    load = 0.0 if rare[0] else load
    mu = 0.0 if rare[1] else mu
    creepages *= 1e-6 if rare[2] else 1.0
    creepages[rng.integers(3)] *= 0.0 if rare[3] else 1.0
    law, kinetic, half_speed = int(rng.integers(len(LAWS))), mu * rng.uniform(0.2, 1.0), 10 ** rng.uniform(-2.0, 1.0)
    slopes = (
        (rng.uniform(0.2, 1.0), rng.uniform(0.0, 1.0), rng.uniform(0.1, 2.0)) if rng.random() < 0.5 else (1.0, 1.0, 1.0)
    )
    velocity = int(rng.integers(len(VELOCITIES)))
    sides = (rng.uniform(0.1, 2.0), rng.uniform(-5e-3, 5e-3), rng.uniform(-5e-3, 5e-3))
    sides = sides if rng.random() < 0.5 else (1.0, 0.0, 5e-3)
    limit = rng.uniform(3e8, 2e9) if rng.random() < 0.3 else 0.0
    polach = (rng.uniform(0.1, 1.0), rng.uniform(0.1, 1.0))
    hot = (rng.uniform(0.2, 0.9), rng.uniform(250.0, 500.0), 10 ** rng.uniform(1.0, 3.0), rng.uniform(250.0, 400.0))
    hot = hot if rng.random() < 0.3 else (1.0, 293.15, 400.0, 293.15)
    thermal = (rng.uniform(20.0, 80.0), rng.uniform(7e3, 8e3), rng.uniform(400.0, 500.0), rng.uniform(0.5, 1.0))
    bent = rng.random() < 0.3
    tilt, rolling = rng.uniform(-0.2, 0.2) + rng.uniform(-20, 20) * y, rng.uniform(0.0, 3.0)
    values = {
        **named("geometry", kind=2 if curvatures else 1, y0=y0, dy=dy, surface=2 if bent else 1, rolling=rolling),
        **{f"geometry.g[{i}]": v for i, v in enumerate(g, 1)},
        **{f"geometry.A[{i}]": v for i, v in enumerate(A, 1)},
        **{f"geometry.tilt[{i}]": v for i, v in enumerate(tilt, 1)},
        **named("geometry", A0=A[20], B0=B),
        **named("load", kind=1 if by_load else 2, normal_force=load, approach=approach),
        **dict(zip(CREEPAGES, creepages.tolist(), strict=True)),
        **named("material", shear_modulus=G, poisson_ratio=nu, hardness=H, shear_yield=k, pressure_limit=limit),
        **named("friction", coefficient=mu, law=law + 1, kinetic=kinetic, half_speed=half_speed, velocity=velocity + 1),
        **dict(zip(("friction.slope", "friction.slope_far", "friction.slope_rate"), slopes, strict=True)),
        **dict(zip(("friction.gauge_factor", "friction.border", "friction.border_width"), sides, strict=True)),
        **dict(zip(("friction.k_A", "friction.k_S"), polach, strict=True)),
        **dict(zip(HEAT, (*hot, *thermal), strict=True)),
        **{"speed": speed, "wheel.radius": radius, "method.normal": normal + 1, "method.tangential": tangential + 1},
        **named("resolution", n_strips=n_strips, n_elements=n_elements),
    }
    methods = {"normal": list(METHODS.normal)[normal], "tangential": list(METHODS.tangential)[tangential]}
    whole = contact.Separation(y, g, A, tilt=tilt, rolling=rolling)
    solution = contact.solve(
        contact.Separation.hertzian(A[20], B) if curvatures else whole,
        contact.Creepage(*creepages),
        **{"load": load} if by_load else {"approach": approach},
        friction=Friction(
            *(mu, kinetic, half_speed, LAWS[law], *slopes, VELOCITIES[velocity], *sides, *polach, *hot),
            thermal=Thermal(*thermal),
        ),
        material=contact.Material(G, nu, hardness=H, shear_yield=k, pressure_limit=limit or math.inf),
        speed=speed, **methods, n_strips=n_strips, n_elements=n_elements, throw=False,
        conformal=bent and METHODS.tangential[methods["tangential"]].fields,
    )  # fmt: skip
    return Case(seed, values, solution)
