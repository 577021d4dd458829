"""angen automation-test on the command line."""
import argparse
from pathlib import Path
from typing import Any

from angen_tools.cli.parser import add_allow_paths, add_json, add_out, command
from angen_tools.common.files import check_folder


def run_test(args: argparse.Namespace) -> int:
    from angen_apps.automation.command import compare, list_entities, test
    if args.entities:
        return list_entities(args.scenario[0], args.json)
    check_folder(args.out)
    if bool(args.automation) + bool(args.compare) + bool(args.program) > 1:
        args.parser.error('--automation, --program and --compare exclude one another')
    if args.compare:
        if len(args.scenario) > 1:
            args.parser.error('--compare takes one scenario')
        return compare(args.scenario[0], args.compare, args.out, args.json)
    return test(args.scenario, args.automation, args.out, args.json, args.program)


def add_automation_test(commands: Any) -> None:
    """angen automation-test."""
    made = command(commands, 'automation-test', run_test,
                   'tries home automations on simulated people, and judges what they do; needs no '
                   'simulator, no broker and no Home Assistant',
                   'automation-test examples/automation/hall_light.yaml',
                   'automation-test my_scenario.yaml --automation my_automations.yaml',
                   'automation-test month.yaml --compare naive.yaml good.yaml',
                   more='exit code: 0 all expectations hold, 1 one failed, 2 a mistake in a file, '
                   'or an expectation that was not judged')
    made.set_defaults(parser=made)
    made.add_argument('scenario', metavar='SCENARIO', type=Path, nargs='+',
                      help='a YAML file, as docs/automation.md describes it')
    made.add_argument('--automation', metavar='FILE', type=Path, nargs='+', default=(),
                      help="automations of Home Assistant instead of the scenario's")
    made.add_argument('--program', metavar='COMMAND', default='',
                      help="a program on MQTT instead of the scenario's automation")
    made.add_argument('--compare', metavar='FILE', type=Path, nargs=2,
                      help='two automations over the same days: comfort, energy, false alarms')
    made.add_argument('--entities', action='store_true',
                      help="lists the ids of the home's entities")
    add_allow_paths(made)
    add_json(made)
    add_out(made, 'junit.xml, automation.png, commands.csv, states.csv')
