"""Damage by one pair on both of its profiles, accumulated over the distance."""

from contact.core import kernel
from contact.kernels.damage.deposit import deposit, place, strip_rates
from contact.kernels.rows import Body


@kernel
def enter(patch, n, damage, arrays):
    """Add the damage by the `n` strips of one patch to both profiles of the ledger of `PairArrays`.

    The strips are those of the right side.
    """
    ledger, strips, fields = arrays.ledger, arrays.workspace.strips, arrays.workspace.fields
    settings, rates, edges = ledger.settings[0], ledger.rates, ledger.edges
    forward = arrays.result[0].Fx
    strip_rates(strips, n, fields, arrays.damage_parameters[0], damage, arrays.damage_fields, forward, rates)
    on_wheel, on_rail = (patch.wheel_y, patch.wheel_z), (patch.rail_y, patch.rail_z)
    place(ledger.wheel, ledger.wheel_arc, on_wheel, patch.angle, 1.0, strips, n, edges)
    deposit(rates, edges, strips, n, settings, patch.share, True, 1.0, ledger.bins[Body.WHEEL])
    place(ledger.rail, ledger.rail_arc, on_rail, patch.angle, 1.0, strips, n, edges)
    of_rail = arrays.damage_parameters[0].rail_wear
    deposit(rates, edges, strips, n, settings, patch.share, False, of_rail, ledger.bins[Body.RAIL])
