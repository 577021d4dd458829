"""A node ends without a traceback when it is shut down, and with one when it fails."""
import subprocess
import sys

import pytest

FAILS = '''
import rospy
def main():
    {before}
    raise rospy.ROSException('publish() to a closed topic')
'''


@pytest.mark.parametrize('before, code', [('rospy.signal_shutdown("a signal")', 0), ('pass', 1)])
def test_a_node_that_was_shut_down_may_fail(before, code, tmp_path):
    (tmp_path / 'node_that_fails.py').write_text(FAILS.format(before=before))
    program = (f'import sys; sys.path.insert(0, {str(tmp_path)!r})\n'
               'from angen_tools.common.program import run_node\nrun_node("node_that_fails")')
    done = subprocess.run([sys.executable, '-c', program], capture_output=True, text=True,
                          check=False)
    assert done.returncode == code
    assert ('Traceback' in done.stderr) is (code == 1), done.stderr
