"""Between messages and records of what the mode manager says, and of what it asks the driver."""

import math

from builtin_interfaces.msg import Time

from pdr_core.conventions import NO_STAMP
from pdr_core.records_power import Charge, DriverAnswer, Energy, Mode, ModeCommand, ModeReport, Outcome, RateAnswer
from pdr_msgs.msg import NavigationMode
from pdr_msgs.srv import SetGyroPower, SetSampleRate
from pdr_nodes.convert import stamp_ns, time_message

ANSWERS = {
    Outcome.ACKNOWLEDGED: NavigationMode.ANSWER_ACKNOWLEDGED,
    Outcome.REFUSED: NavigationMode.ANSWER_REFUSED,
    Outcome.TIMED_OUT: NavigationMode.ANSWER_TIMED_OUT,
    Outcome.DIED: NavigationMode.ANSWER_DIED,
}
OUTCOMES = {number: outcome for outcome, number in ANSWERS.items()}
MODES = {mode.value: mode for mode in Mode}
NOT_BEGUN = "nothing was heard of a walk yet"


def gyro_answer(command: ModeCommand, response: SetGyroPower.Response) -> DriverAnswer:
    """Return what the driver says to a command; a stamp of zero says that it holds at once."""
    outcome = Outcome.ACKNOWLEDGED if response.success else Outcome.REFUSED
    effective_ns = stamp_ns(response.effective) or command.stamp_ns
    settling_s = response.settling_time if math.isfinite(response.settling_time) else 0.0
    return DriverAnswer(command.number, command.stamp_ns, outcome, effective_ns, settling_s, response.message)


def rate_answer(command: ModeCommand, response: SetSampleRate.Response) -> RateAnswer:
    """Return what the driver says of its rate; one that is no rate is a refusal."""
    taken = response.success and 0.0 < response.rate < math.inf
    text = response.message or f"the driver says {response.rate:g} Hz"
    return RateAnswer(response.rate if taken else 0.0, stamp_ns(response.effective) or command.stamp_ns, text)


def mode_message(report: ModeReport) -> NavigationMode:
    """Return what the mode manager says as a message."""
    message = NavigationMode(reason=NOT_BEGUN, gyro_requested=True)
    message.header.stamp = time_message(report.stamp_ns)
    if command := report.command:
        message.mode, message.command, message.reason = command.mode.value, command.number, command.why
        message.decided = time_message(command.stamp_ns)
        message.step_model_failed = command.model_failed
        message.gyro_requested, message.sample_rate_requested = command.gyro, command.rate_hz
    if answer := report.answer:
        message.answer, message.answer_text = ANSWERS[answer.outcome], answer.text
        message.settling_time = answer.settling_s
        message.applies_from = Time() if answer.effective_ns == NO_STAMP else time_message(answer.effective_ns)
    message.gyro_powered, message.sample_rate = report.gyro_powered, report.rate_hz
    with_energy(message, report.energy)
    return message


def with_energy(message: NavigationMode, energy: Energy) -> None:
    """Fill a message with what all has cost."""
    message.part, message.duration, message.gyro_on = energy.part, energy.duration_s, energy.gyro_on_s
    message.switch_ons, message.start_up_charge = energy.switch_ons, energy.start_up_mah
    message.sensor_charge, message.node_charge = energy.drawn.sensor_mah, energy.drawn.node_mah
    always = energy.always_on
    message.sensor_charge_always_on, message.node_charge_always_on = always.sensor_mah, always.node_mah


def mode_report(message: NavigationMode) -> ModeReport:
    """Return a message as what the mode manager says."""
    command, answer = None, None
    if message.command:
        decided_ns, mode = stamp_ns(message.decided), MODES[message.mode]
        wish = message.gyro_requested, message.sample_rate_requested, decided_ns, mode is Mode.SWINGS
        command = ModeCommand(message.command, decided_ns, mode, message.reason, *wish, message.step_model_failed)
    if outcome := OUTCOMES.get(message.answer):
        effective_ns = stamp_ns(message.applies_from) or NO_STAMP
        stamps = stamp_ns(message.header.stamp), outcome, effective_ns
        answer = DriverAnswer(message.command, *stamps, message.settling_time, message.answer_text)
    powered = message.gyro_powered, message.sample_rate
    return ModeReport(stamp_ns(message.header.stamp), command, answer, *powered, energy_record(message))


def energy_record(message: NavigationMode) -> Energy:
    """Return what a message says that all has cost."""
    drawn = Charge(message.sensor_charge, message.node_charge)
    always = Charge(message.sensor_charge_always_on, message.node_charge_always_on)
    start_up = message.switch_ons, message.start_up_charge
    return Energy(message.part, message.duration, message.gyro_on, *start_up, drawn, always)
