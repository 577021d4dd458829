"""The errors that the angen command reports."""


class Failure(Exception):
    """Ends the command with its text as one line on stderr, and exit code 1."""

    def __str__(self) -> str:
        return '; '.join(line.strip() for line in super().__str__().splitlines() if line.strip())


class WrongWords(Failure):
    """A mistake in the words of a command: exit code 2."""


def code_of(failure: Failure) -> int:
    """The exit code of a command that ends with it."""
    return 2 if isinstance(failure, WrongWords) else 1
