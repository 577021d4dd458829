"""What orders of pages and drafts may contain beside a drawing, whose numbers plan/drawing.py
limits."""
from typing import Any

from angen_apps.data.shapes import number
from angen_apps.plan.drawing import MOST

AT = number(0, 1e15)  # ms since 1970


def storey(value: Any) -> None:
    """The number of a storey, or none."""
    if value is not None:
        number(-MOST, MOST, whole=True)(value)


ORDER = {'at?': AT, 'floor?': storey}
DRAFT = {'at': AT, 'drawing': {}}
