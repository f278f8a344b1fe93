# SPDX-License-Identifier: Apache-2.0
"""Requests whose bytes are mutated, to both doors of a served microscope: each is answered, and the server neither ends nor grows.

AFM_FUZZ_SECONDS=600 lets each door have ten minutes instead of twenty seconds; AFM_FUZZ_SEED is 1 by default. Needs no sanitizer: the fuzz
targets requests and nanonis have it.
"""

import json
import os
import pathlib
import random
import re
import socket
import struct
import subprocess
import tempfile
import time
import unittest

SECONDS = float(os.environ.get("AFM_FUZZ_SECONDS", "20"))
SEED = int(os.environ.get("AFM_FUZZ_SEED", "1"))
CORPUS = pathlib.Path(__file__).resolve().parent.parent / "fuzz" / "corpus" / "requests"
MORE = [b'{"id": 1, "do": "curve", "points": 20, "z_from_m": 2e-8, "z_to_m": -5e-9, "arrays": "base64"}',
        b'{"id": "a", "do": "scan"}', b'{"do": "thermal", "points": 30, "averages": 2}', b'{"do": "save", "file": "a.gwy"}',
        b'{"do": "set", "values": {"pixels": 4, "lines": 2, "size_m": 2e-8, "blunting_force_N": 1e-9, "false_engagement": 0.5}}',
        b'{"do": "approach"}', b'{"do": "tapping_curve", "points": 9}', b'{"do": "set", "values": {"mode": "tapping", "law": "dmt"}}']
WORDS = [b"null", b"1e308", b"-1e308", b"1e-320", b"0", b"-1", b"2", b"NaN", b"[]", b"{}", b'"\\u0000"', b'"\xff"', b"true", b'""', b"1e999"]
FUNCTIONS = ("Signals.NamesGet Signals.ValGet Signals.ValsGet Signals.InSlotsGet Bias.Set Bias.Get Current.Get ZCtrl.ZPosGet ZCtrl.ZPosSet "
             "ZCtrl.OnOffGet ZCtrl.OnOffSet ZCtrl.SetpntGet ZCtrl.SetpntSet ZCtrl.GainGet ZCtrl.GainSet ZCtrl.Withdraw ZCtrl.Home "
             "ZCtrl.StatusGet Scan.Action Scan.StatusGet Scan.WaitEndOfScan Scan.FrameGet Scan.FrameSet Scan.BufferGet Scan.PropsGet "
             "Scan.PropsSet Scan.SpeedGet Scan.SpeedSet Scan.FrameDataGrab FolMe.XYPosGet FolMe.XYPosSet FolMe.SpeedGet FolMe.SpeedSet "
             "AutoApproach.Open AutoApproach.OnOffGet AutoApproach.OnOffSet Motor.StartMove Nothing.Get").split()
# A count of three digits, or a swing that is integrated directly, makes an answer that takes seconds; "quit" has a test of its own.
LONG = re.compile(rb'(pixels|lines|points|averages)\D{0,9}\d{3}|quit|quality_factor')


def mutated(chance, request):
    bytes_ = bytearray(request)
    for _ in range(chance.randrange(1, 4)):
        at = chance.randrange(len(bytes_) + 1)
        how = chance.randrange(5)
        if how == 0:
            bytes_[at:at + 1] = bytes([chance.randrange(256)])
        elif how == 1:
            del bytes_[at:at + chance.randrange(1, 9)]
        elif how == 2:
            bytes_[at:at] = bytes_[:chance.randrange(len(bytes_) + 1)]
        elif how == 3:
            bytes_[at:at] = chance.choice(WORDS)
        else:
            numbers = list(re.finditer(rb"-?\d[\d.e-]*|\"[a-z_A-Z]*\"", bytes(bytes_)))
            if numbers:
                chosen = chance.choice(numbers)
                bytes_[chosen.start():chosen.end()] = chance.choice(WORDS)
    return bytes(bytes_).replace(b"\n", b" ")


class Mutated(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "socket")
        self.server = subprocess.Popen([os.environ["TOUCHAFM"], "serve", "--socket", self.path, "--nanonis", "0"], stderr=subprocess.PIPE,
                                       cwd=folder.name, text=True)
        self.addCleanup(self.server.stderr.close)
        self.addCleanup(self.server.wait)
        self.addCleanup(self.server.kill)
        self.assertIn("listens on", self.server.stderr.readline())
        self.port = int(re.search(r"port (\d+)", self.server.stderr.readline()).group(1))
        self.chance = random.Random(SEED)

    def connected(self, address):
        client = socket.socket(socket.AF_INET if isinstance(address, tuple) else socket.AF_UNIX)
        self.addCleanup(client.close)
        client.settimeout(60)
        client.connect(address)
        return client

    def resident_kib(self):
        status = pathlib.Path(f"/proc/{self.server.pid}/status").read_text(encoding="ascii")
        return int(re.search(r"VmRSS:\s*(\d+)", status).group(1))

    def expect_answers(self, ask):
        counts, before, end = {True: 0, False: 0}, None, time.monotonic() + SECONDS
        while time.monotonic() < end:
            counts[ask()] += 1
            if before is None and sum(counts.values()) == 500:
                before = self.resident_kib()
        self.assertIsNone(self.server.poll(), "the server has ended")
        print(f"{sum(counts.values())} requests, {counts[True]} accepted; {self.resident_kib() - before} KiB more than after the first 500")
        self.assertGreater(counts[True], 20)
        self.assertGreater(counts[False], 20)
        self.assertLess(self.resident_kib() - before, 65536)

    def test_in_json(self):
        lines = [line for file in sorted(CORPUS.iterdir()) for line in file.read_bytes().splitlines() if line] + MORE
        client = self.connected(self.path)
        answers = client.makefile("rb")
        self.addCleanup(answers.close)
        asked = 0

        def ask():
            nonlocal asked
            asked += 1
            request = b'{"do": "hello", "seed": 1}' if asked % 40 == 0 else MORE[4] if asked % 40 == 1 else mutated(
                self.chance, self.chance.choice(lines))
            if LONG.search(request) or len(request) > 60_000:
                request = b'{"do": "get"}'
            client.sendall(request + b"\n")
            while True:
                line = answers.readline()
                self.assertTrue(line.endswith(b"\n"), request)
                answer = json.loads(line)
                if "line" not in answer:
                    return answer["ok"]

        self.expect_answers(ask)

    def test_in_nanonis_protocol(self):
        client = self.connected(("127.0.0.1", self.port))

        def received(size):
            bytes_ = b""
            while len(bytes_) < size:
                more = client.recv(size - len(bytes_))
                self.assertTrue(more, "the server has left")
                bytes_ += more
            return bytes_

        def ask():
            name = self.chance.choice(FUNCTIONS).encode().ljust(32, b"\0")
            usual = b"".join(self.chance.choice((struct.pack(">I", self.chance.randrange(5)), struct.pack(">f", self.chance.gauss(0, 1e-8)),
                                                 self.chance.randbytes(4), b"\x7f\xc0\0\0", b"\0\1")) for _ in range(self.chance.randrange(7)))
            client.sendall(name + struct.pack(">IHH", len(usual), 1, 0) + usual)
            header = received(40)
            self.assertEqual(header[:32], name)
            body = received(struct.unpack(">I", header[32:36])[0])
            return body.endswith(bytes(8))

        client.sendall(b"Scan.BufferSet".ljust(32, b"\0") + struct.pack(">IHH", 12, 0, 0) + struct.pack(">iii", 0, 8, 4))
        self.expect_answers(ask)


if __name__ == "__main__":
    unittest.main()
