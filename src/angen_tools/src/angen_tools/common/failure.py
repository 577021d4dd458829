"""The error that the angen command reports."""


class Failure(Exception):
    """Ends the command with exit code 1 and its text as one line on stderr."""

    def __str__(self) -> str:
        return '; '.join(line.strip() for line in super().__str__().splitlines() if line.strip())
