"""The commands of angen_apps, which the angen command finds here."""
from typing import Any

from angen_apps.cli import (apartment, automation, care, data, edit, go, imports, locate, maps,
                            mqtt, patrol, plan, situations, walktest, web)


def add_commands(commands: Any) -> None:
    """Adds each command to the parser of angen."""
    for add in (maps.add_map, go.add_go, patrol.add_task, walktest.add_walktest,
                situations.add_situations, care.add_care, locate.add_locate, imports.add_import,
                plan.add_plan, apartment.add_home, data.add_household, data.add_generate,
                data.add_validate, data.add_realism, web.add_web, edit.add_edit, mqtt.add_mqtt,
                automation.add_automation_test):
        add(commands)
