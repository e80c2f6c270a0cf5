"""What a run says of itself: one that can be trusted and one that cannot."""

from contact_models.runs.trust import Trust

GOOD = Trust(residual=0.001, impacts=0.0, lifted=0.0, untrusted=0.0, creepage=0.01, speed_ratio=0.5, unfinished=0.0)
BAD = Trust(residual=-0.49, impacts=3.0, lifted=2.0, untrusted=7.0, creepage=3.0, speed_ratio=1.2, unfinished=1.0)
