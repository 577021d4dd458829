"""Colors of the page that no style of an element has: of its drawings, in both themes."""
import re
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[2] / 'src/angen_apps/page'
TEXT, GRAPHIC = 4.5, 3.0  # the least ratios of WCAG 2.2, AA
LIGHT, DARK = re.findall(r'^:root.*?{(.*?)}', (PAGE / 'style.css').read_text(), re.M | re.S)[:2]
THEMES = [dict(re.findall(r'--([a-z-]+): (#[0-9a-f]{6})', theme)) for theme in (LIGHT, DARK)]


def luminance(color: str) -> float:
    shares = [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4
                        for x in shares)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def ratio(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_the_ratio_is_that_of_wcag() -> None:
    assert ratio('#000000', '#ffffff') == pytest.approx(21)
    assert ratio('#777777', '#ffffff') == pytest.approx(4.48, abs=0.01)


def test_activities_are_reported_from_what_is_behind_them_and_their_names_are_read() -> None:
    line, = re.findall(r'COLORS = \[(.*?)\]', (PAGE / 'js/player.js').read_text())
    colors = re.findall('#[0-9a-f]{6}', line)
    assert len(colors) == len(set(colors)) >= 12
    for color in colors:
        assert ratio(color, '#ffffff') >= TEXT, color
        for theme in THEMES:
            assert ratio(color, theme['surface']) >= GRAPHIC, color


@pytest.mark.parametrize('theme', THEMES)
def test_what_is_drawn_is_reported_from_what_is_behind_it(theme: dict[str, str]) -> None:
    scan, = re.findall(r"fillStyle = '(#[0-9a-f]{6})'", (PAGE / 'js/robotmap.js').read_text())
    for drawn, behind in (('edge', 'surface'), ('edge', 'bg'), ('edge', 'lamp-soft'),
                          ('soft', 'room'), ('wall', 'room'), ('accent', 'room'),
                          ('robot', 'room'), ('warn', 'room'), ('accent', 'surface'),
                          ('accent', 'accent-soft'), ('accent', 'bg')):
        assert ratio(theme[drawn], theme[behind]) >= GRAPHIC, (drawn, behind)
    assert ratio(scan, theme['room']) >= GRAPHIC
