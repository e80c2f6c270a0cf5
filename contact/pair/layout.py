"""Where each number lives in what `solve_pair` says; signs are those of the actual side."""

# contacts[k, ...]: one patch; forces on the wheel in the contact frame
(
    CONTACT_N,
    CONTACT_FX,
    CONTACT_FY,
    CONTACT_MX,  # of the normal pressure about the reference point [N m]
    CONTACT_MY,
    CONTACT_MZ,
    CONTACT_X,  # wheel's point opposite the reference point, where these act, in track coordinates [m]
    CONTACT_Y,
    CONTACT_Z,
    CONTACT_ANGLE,
    CONTACT_AREA,
    CONTACT_PMAX,
    CONTACT_LONGITUDINAL,  # creepages there [-], [-], [1/m]
    CONTACT_LATERAL,
    CONTACT_SPIN,
    CONTACT_APPROACH,
    CONTACT_STATUS,
) = range(17)
N_CONTACT = 17

# total[...]: all patches together
(
    TOTAL_FX,  # on the wheel, track coordinates [N]
    TOTAL_FY,
    TOTAL_FZ,
    TOTAL_MX,  # about the wheelset's centre [N m]
    TOTAL_MY,
    TOTAL_MZ,
    TOTAL_Z,  # pose.z, as given or as found [m]
    TOTAL_COUNT,
    TOTAL_STATUS,
    TOTAL_PMAX,
    TOTAL_AREA,
    TOTAL_SLIP_AREA,
    TOTAL_POWER,  # dissipated energy per metre rolled [N]
    TOTAL_DAMAGE,  # first of the numbers of `contact.damage._kernel`, added up or the greatest
) = range(14)
