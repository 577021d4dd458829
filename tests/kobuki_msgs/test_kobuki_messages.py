"""Programs connect where types have the md5 sums of kobuki_msgs 0.7."""
from pathlib import Path

from genmsg import MsgContext
from genmsg.gentools import compute_md5
from genmsg.msg_loader import load_msg_from_file

PACKAGE = Path(__file__).resolve().parents[2] / 'src/kobuki_msgs'
MD5 = {'BumperEvent': 'ffe360cd50f14f9251d9844083e72ac5',
       'CliffEvent': 'c5b106efbb1427a94f517c5e05f06295',
       'MotorPower': '8f77c0161e0f2021493136bb5f3f0e51',
       'WheelDropEvent': 'e102837d89384d67669a0df86b63f33b'}


def test_the_definitions_are_kobuki_s() -> None:
    context = MsgContext.create_default()
    assert MD5 == {path.stem: compute_md5(context, load_msg_from_file(
        context, str(path), f'kobuki_msgs/{path.stem}')) for path in PACKAGE.glob('msg/*.msg')}
