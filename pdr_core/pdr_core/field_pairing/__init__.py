"""Which measurement of the magnetic field belongs to which inertial sample: by stamps alone, live and offline."""

from pdr_core.field_pairing.pairing import FieldPairing

__all__ = ["FieldPairing"]
