"""One sentence that says what is wrong and what to do next."""


class DesirePathError(ValueError):
    """Bad input, told in a sentence for the person at the screen."""
