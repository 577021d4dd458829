"""The parameters of /gazebo by dynamic_reconfigure, against those of get_physics_properties."""
from __future__ import annotations

import math
from typing import Any, Iterator

import pytest
from dynamic_reconfigure.msg import BoolParameter, Config, ConfigDescription, DoubleParameter
from dynamic_reconfigure.msg import StrParameter
from dynamic_reconfigure.srv import Reconfigure
from gazebo_scene import Gazebo
from harness import Angen
from rospy import ServiceException


@pytest.fixture(scope="module")
def gazebo(angen: Angen) -> Iterator[Gazebo]:
    yield Gazebo(angen)


def test_parameters_of_dynamic_reconfigure(gazebo: Gazebo, angen: Angen) -> None:
    from dynamic_reconfigure.client import Client
    described = angen.wait("/gazebo/parameter_descriptions", ConfigDescription)
    names = [p.name for p in described.groups[0].parameters]
    assert len(names) == 15 and names[0] == "time_step" and "max_contacts" in names
    client = Client("/gazebo", timeout=20)
    try:
        changed = client.update_configuration({"gravity_x": 0.5, "sor_pgs_w": 1.25})
        assert changed["gravity_x"] == 0.5 and changed["sor_pgs_w"] == 1.25
        now = gazebo.call("get_physics_properties")
        assert now.gravity.x == 0.5 and now.ode_config.sor_pgs_w == 1.25
        update = angen.wait("/gazebo/parameter_updates", Config)
        assert {d.name: d.value for d in update.doubles}["gravity_x"] == 0.5
        client.update_configuration({"gravity_x": 0.0})
    finally:
        client.close()
    assert gazebo.call("get_physics_properties").gravity.x == 0.0


@pytest.mark.parametrize("nonsense, reason", [
    ({"doubles": [DoubleParameter("gravity_w", 1.0)]},
     "there is no parameter 'gravity_w' of type double"),
    ({"bools": [BoolParameter("gravity_x", True)]},
     "there is no parameter 'gravity_x' of type bool"),
    ({"doubles": [DoubleParameter("gravity_y", 1.0), DoubleParameter("gravity_x", math.nan)]},
     "the parameter gravity_x is not a number"),
    ({"strs": [StrParameter("gravity_x", "up")]}, "there is no parameter 'gravity_x'")])
def test_parameters_that_make_no_sense_are_rejected_with_the_reason(
        gazebo: Gazebo, angen: Angen, nonsense: dict[str, Any], reason: str) -> None:
    before = gazebo.call("get_physics_properties")
    with pytest.raises(ServiceException, match=reason):
        angen.call("/gazebo/set_parameters", Reconfigure, config=Config(**nonsense))
    assert gazebo.call("get_physics_properties") == before
