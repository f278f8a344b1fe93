# SPDX-License-Identifier: Apache-2.0
"""The data of a study: its trials as columns, its figures as the command's JSON."""

import json
import os
import pathlib
import tempfile
import unittest

import numpy as np

import touchafm
from command import error_of, touchafm as command

EVENTS = ("onset\tduration\tstep\ttrial_type\tcondition\tpractice\ttrial\tlevel\tstimulus\tresponse\tcorrect\trt\n"
          "1\t1.5\tblind\tidentify\tforce\t1\t1\tn/a\tmica\tmica\t1\t0.8\n"
          "3\t1.5\tblind\tidentify\tforce\t0\t2\tn/a\tgold\tmica\t0\t1.2\n"
          "5\t1.5\tblind\tidentify\tforce\t0\t3\tn/a\tmica\tn/a\tn/a\tn/a\n")
FACTS = {"onset": {"Units": "s"},
         "Lesson": {"id": "three", "title": {"en": "Three materials"}, "digest": "a1b2", "seed": 7, "program": "0.3.0",
                    "device": "sim", "scale": "common", "wall": "desk", "started_day": 0, "observer": {"seed": 7}}}


def write_study(folder):
    """One person who did one lesson."""
    person = pathlib.Path(folder, "sub-ABCDEF", "beh")
    person.mkdir(parents=True)
    pathlib.Path(folder, "participants.tsv").write_text(
        "participant_id\torder\tage_band\tcomfort\nsub-ABCDEF\t1\t18-24\tn/a\n", encoding="utf-8")
    name = "sub-ABCDEF_task-three_events"
    (person / f"{name}.tsv").write_text(EVENTS, encoding="utf-8")
    (person / f"{name}.json").write_text(json.dumps(FACTS), encoding="utf-8")


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = os.path.join(folder.name, "class")
        write_study(self.folder)

    def test_is_the_json_of_the_command(self):
        study = touchafm.study(self.folder)
        out = os.path.join(self.folder, "report")
        done = command("study", self.folder, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(out, "study.json"), encoding="utf-8") as file:
            self.assertEqual(study.as_dict(), json.load(file))
        self.assertEqual(study.participants, ["sub-ABCDEF"])

    def test_has_every_trial_as_columns(self):
        trials = touchafm.study(self.folder).trials
        self.assertEqual({len(column) for column in trials.values()}, {3})
        self.assertEqual(trials["lesson"], ["three"] * 3)
        self.assertEqual(trials["stimulus"], ["mica", "gold", "mica"])
        np.testing.assert_array_equal(trials["practice"], [True, False, False])
        np.testing.assert_array_equal(trials["right"], [1.0, 0.0, np.nan])
        np.testing.assert_array_equal(trials["reaction_time"], [0.8, 1.2, np.nan])
        self.assertTrue(np.isnan(trials["level"]).all())

    def test_refuses_with_the_words_of_the_command(self):
        nothing = os.path.join(self.folder, "sub-ABCDEF")
        with self.assertRaises(touchafm.FileError) as refused:
            touchafm.study(nothing)
        self.assertEqual(str(refused.exception), error_of("study", nothing, "--out", os.path.join(self.folder, "report")))


if __name__ == "__main__":
    unittest.main()
