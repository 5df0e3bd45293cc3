"""How much the headings of strides differ from one another on straight lines."""

KNOWN_BEFORE = 3.0  # strides that the first guess counts for


class Spread:
    """The standard deviation of a stride's heading, from all straight strides so far and a first guess."""

    def __init__(self, first_guess_rad: float) -> None:
        self._strides = KNOWN_BEFORE
        self._sum_rad2 = KNOWN_BEFORE * first_guess_rad**2

    def add(self, deviation_rad: float, strides: int) -> None:
        """Take the deviation of a stride from the mean of so many, itself among them."""
        self._strides += 1.0
        self._sum_rad2 += deviation_rad**2 * strides / (strides - 1)

    @property
    def variance_rad2(self) -> float:
        """Variance of a heading about that of its line."""
        return self._sum_rad2 / self._strides
