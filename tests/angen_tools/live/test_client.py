"""The angen command's way to the simulator, without one."""
from __future__ import annotations

import subprocess
import sys

COMMAND = '''
import sys
from angen_tools.live import client, listing
client.import_genpy()
import rospy
from angen_msgs.srv import List
from geometry_msgs.msg import Point
print('numpy' in sys.modules)
import io, numpy
Point(numpy.float64(1), numpy.float32(2), 3).serialize(io.BytesIO())
print(numpy.arange(3).sum())
'''


def test_a_command_starts_without_numpy() -> None:
    done = subprocess.run([sys.executable, '-c', COMMAND], text=True, capture_output=True)
    assert (done.stdout, done.stderr) == ('False\n3\n', '')
