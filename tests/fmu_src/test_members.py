"""The table of an FMU says of which record of the kernels a variable is a member; the packagings copy by it."""

import pytest

from contact.inputs.options import MEMBERS
from contact.kernels import records
from contact_fmu.rows import output
from contact_fmu.tables import wheel_rail_contact, wheel_rail_pair, wheel_rail_surfaces

TABLES = [wheel_rail_contact.table(), wheel_rail_pair.table(), wheel_rail_surfaces.table()]
#: Damage that no FMU shows.
UNSHOWN = {"T_gamma_spin", "dissipation"}


@pytest.fixture(params=TABLES, ids=lambda table: table.name)
def table(request):
    return request.param


def placed(table):
    return [(row, *row.member.split(".")) for row in table.rows if row.member]


def test_every_member_that_a_row_names_is_in_its_record(table):
    for row, record, member in placed(table):
        assert member in getattr(records, record.upper()).names, row.name


def test_a_row_without_unit_and_description_has_those_of_the_record(table):
    row = output("patch.fy", member="contact.Fy")
    assert (row.description, row.unit) == ("Lateral creep force on the wheel, along the contact plane", "N")
    assert [row.name for row in table.rows if not row.description] == []


def test_no_two_rows_are_copied_to_the_same_member(table):
    given = [row.member for row, *_ in placed(table) if row.is_given]
    assert len(given) == len(set(given))


def test_every_damage_of_a_patch_and_of_a_pair_is_an_output(table):
    record = "damage" if table.name == "WheelRailContact" else "total"
    shown = set(table.members(record, given=False).values())
    assert set(records.DAMAGE.names) - shown == UNSHOWN


def test_an_fmu_takes_no_number_that_C_refuses(table):
    compared = 0
    for row, record, member in placed(table):
        limits = MEMBERS.get(record, {}).get(member)
        if row.is_given and row.enumeration is None and limits is not None:
            assert limits.least <= row.minimum, row.name
            assert row.maximum <= limits.most, row.name
            compared += 1
    assert compared > 12
