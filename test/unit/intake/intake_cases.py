"""What intake makes of samples, and what it says."""

from pdr_core.intake import Ingestion
from pdr_core.params import IntakeParams
from pdr_core.records import joined


def taken(imu, **params):
    """All samples that go on, and the notices by kind."""
    intake = Ingestion(IntakeParams(**params))
    return joined([intake.run(imu), intake.finish()]), {n.kind: n for n in intake.notices}


def only(notices, kind):
    """The notice of that kind, beside which there is no other."""
    assert list(notices) == [kind]
    return notices[kind]
