# SPDX-License-Identifier: Apache-2.0
"""A server that answers a million requests does not grow, and neither does one whose client does not read."""

import re
import time
import unittest

from touchafm import serve

REQUESTS = 1_000_000
BATCH = 500  # sent at once, so that the server never waits for the client


def memory_kib(afm, entry):
    """An entry of the server's memory: VmRSS, or its peak VmHWM."""
    with open(f"/proc/{afm._server.pid}/status", encoding="utf-8") as status:
        return int(re.search(rf"{entry}:\s*(\d+)", status.read()).group(1))


def lines(afm, count):
    """The next answers as they came."""
    return [afm._answers.readline() for _ in range(count)]


class ManyRequests(unittest.TestCase):
    def test_do_not_let_the_server_grow(self):
        verbs = [b'{"do": "truth"}', b'{"do": "wait", "time_s": 0.1}', b'{"do": "move", "x_m": 1e-9}', b'{"do": "get"}', b'{"do": 7}']
        batch = b"\n".join(verbs[number % len(verbs)] for number in range(BATCH)) + b"\n"
        with serve.start(seed=7) as afm:
            afm.set(pixels=8)
            afm.approach()

            def ask(count):
                for _ in range(count // BATCH):
                    afm._socket.sendall(batch)
                    refused = sum(b'"ok":false' in answer for answer in lines(afm, BATCH))
                    self.assertEqual(refused, BATCH // len(verbs))
                    afm.curve(points=100)
                    afm.scan()

            ask(20 * BATCH)
            before, begin = memory_kib(afm, "VmRSS"), time.monotonic()
            ask(REQUESTS)
            grown = memory_kib(afm, "VmRSS") - before
            print(f"{REQUESTS} requests in {time.monotonic() - begin:.0f} s: {grown} KiB more than before")
            self.assertLess(grown, 4096)  # a leak of 8 bytes a request would be 7800


class SlowReader(unittest.TestCase):
    def test_costs_the_server_no_memory(self):
        requests = 200
        with serve.start(seed=7) as afm:
            afm.curve(points=5000)
            afm._socket.sendall(b'{"do": "curve", "points": 5000}\n')
            answer = lines(afm, 1)[0]
            before = memory_kib(afm, "VmHWM")
            afm._socket.sendall(b'{"do": "curve", "points": 5000}\n' * requests)
            time.sleep(3.0)  # enough to make all of them, for a server that would keep them
            for later in lines(afm, requests):
                self.assertIn(b'"ok":true', later)
            grown = memory_kib(afm, "VmHWM") - before
            print(f"{requests} answers of {len(answer) / 1024:.0f} KiB, read late: the peak grew by {grown} KiB")
            self.assertLess(grown * 1024, 20 * len(answer))


if __name__ == "__main__":
    unittest.main()
