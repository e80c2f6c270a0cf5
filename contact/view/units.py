"""Units of inputs and results by their names: one table for JSON and for tables of pandas and xarray."""

from __future__ import annotations

from contact.kernels.records import MEANING, unit_of

#: Unit → names of inputs and results that have it, besides those of the records. "1" is a pure number.
_NAMES = {
    "m": "cant lead height station origin flat flat_depth begin end spacing step offset roller_radius "
    "deflection_y deflection_z curve_radius smallest_radius needed available radius gauge back_to_back "
    "left_radius reach amplitude penetration profile_smoothing profile_zero profile_wavelength smoothing "
    "wavelength centre position rolling_radius radius_difference right_on_wheel right_on_rail "
    "right_radius left_on_wheel left_on_rail distance at mileage on_rail_y on_rail_z on_wheel_y "
    "on_wheel_z",
    "rad": "rotation turned profile_rotation roll yaw contact_angle angle_difference right_angle left_angle",
    "m/s": "speed velocity",
    "N": "guiding load vertical fx fy force preload force_x force_y normal_force power_per_metre",
    "N m": "torque steering",
    "W": "power",
    "Pa": "p qx qy value pressure_limit max_pressure stress_index_max energy_index_max shear_modulus hardness "
    "shear_yield",
    "K": "temperature",
    "m²": "adhesion_area dA",
    "N/m": "normal_stiffness springs",
    "1/m": "curvatures nonlinearity",
    "m/m": "archard_depth_max",
    "s": "seconds every duration time damping",
    "1": "friction profile_scale inclination slip_ratio utilisation sx sy conicity slope share index "
    "poisson_ratio coupling errors.force errors.moment errors.N errors.approach errors.max_pressure "
    "errors.area errors.pressure",
    "1, 1, 1/m": "creepage",
    "m, m, rad": "shift",
    "Pa, -, Pa, -": "bodies",
    "m/Pa, Pa, Pa/m": "layer",
    "m, m, m, rad, rad, rad": "wheel_offset",
    "m, m/s": "friction_memory",
    "-, 1, m/s": "falling",
    "1, m, m": "gauge_friction",
    "1, K, K": "hot",
    "Pa, 1, 1": "endurance",
    "1, m": "polygon",
}
_OF_RECORDS = {
    name: unit_of(f"{record}.{name}").translate(str.maketrans("23", "²³"))
    for record in ("contact", "total", "result", "damage")
    for name, meaning in MEANING[record].items()
    if "[" in meaning
}
#: A name with a point is that of a member: it goes before the name of the member alone.
UNITS = _OF_RECORDS | {name: unit for unit, names in _NAMES.items() for name in names.split()}
