"""The meter from the node's first second on."""
import statistics
from pathlib import Path

from angen_msgs.msg import Cost
from harness import WORLD, Inbox, Master


def test_the_first_figure_is_like_the_next_ten(master: Master, rospy_node: None,
                                               tmp_path: Path) -> None:
    with Inbox("/angen/cost", Cost) as costs, master.serving(WORLD, tmp_path):
        costs.wait(lambda _: len(costs.messages) > 10, "eleven figures", 60.0)
    figures = [message.process for message in costs.messages[:11]]
    assert all(message.simulated >= 1.0 for message in costs.messages)
    assert costs.messages[0].header.stamp.to_sec() >= 2.0
    median = statistics.median(figures[1:])
    assert figures[0] < 3 * median, figures
