"""Which model a name and a behaviour mean."""

from pdr_core.gait.step_length.constant import CONSTANT
from pdr_core.gait.step_length.frequency_linear import FREQUENCY_LINEAR
from pdr_core.gait.step_length.kim import KIM
from pdr_core.gait.step_length.model import Model
from pdr_core.gait.step_length.weinberg import WEINBERG
from pdr_core.gait.step_length.zhou import RUNNING, WALKING
from pdr_core.records_gait import Behaviour

MODELS = {model.name: model for model in (WALKING, CONSTANT, FREQUENCY_LINEAR, WEINBERG, KIM)}


def model_of(name: str, behaviour: Behaviour) -> Model:
    """Return the model of that name for that behaviour; only Zhou's has one of its own for running."""
    return RUNNING if name == RUNNING.name and behaviour is Behaviour.RUNNING else MODELS[name]
