"""Models of the length of a stride of one foot, one a file; none of them knows a person before it is calibrated."""

from pdr_core.gait.step_length.catalogue import model_of
from pdr_core.gait.step_length.model import Model

__all__ = ["Model", "model_of"]
