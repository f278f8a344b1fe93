# SPDX-License-Identifier: Apache-2.0
"""The command touchafm of this build, beside which the module is tested."""

import json
import os
import subprocess


def touchafm(*arguments):
    """What the command does: its end, output and messages."""
    return subprocess.run([os.environ["TOUCHAFM"], *arguments], capture_output=True, text=True, check=False)


def json_of(*arguments):
    """The JSON that the command prints."""
    result = touchafm(*arguments)
    assert result.returncode == 0, result.stderr
    return json.loads(result.stdout)


def error_of(*arguments):
    """The message with which the command refuses."""
    result = touchafm(*arguments)
    assert result.returncode != 0, result.stdout
    return result.stderr.strip().removeprefix("touchafm: error: ")


def without_sources(result):
    """Without the texts that say who gave a number."""
    return {key: value for key, value in result.items() if key != "sources"}


_GIVERS = ("given by a program", "on the command line")


def whoever_gave_it(result):
    """With one text for every number that a program or a person gave, whose words differ."""
    if isinstance(result, dict):
        if str(result.get("source", "")).endswith(_GIVERS):
            return "given"
        return {key: whoever_gave_it(value) for key, value in result.items()}
    if isinstance(result, list):
        return [whoever_gave_it(each) for each in result]
    return "given" if isinstance(result, str) and result.endswith(_GIVERS) else result
