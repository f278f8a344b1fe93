# SPDX-License-Identifier: Apache-2.0
"""A server that answers very many requests does not grow. REQUESTS sets their number."""

import os
import re
import unittest

from touchafm import serve


class ManyRequests(unittest.TestCase):
    def test_do_not_let_the_server_grow(self):
        requests = int(os.environ.get("REQUESTS", "100000"))
        with serve.start(seed=7) as afm:
            afm.set(pixels=8)
            afm.approach()

            def resident_kib():
                with open(f"/proc/{afm._server.pid}/status", encoding="utf-8") as status:
                    return int(re.search(r"VmRSS:\s*(\d+)", status.read()).group(1))

            def ask(count):
                for number in range(count):
                    afm.request(("get", "truth", "wait", "move")[number % 4], **({"time_s": 0.1} if number % 4 == 2 else {}))
                    if number % 500 == 0:
                        afm.curve(points=100)
                        afm.scan()
                        with self.assertRaises(serve.Refused):
                            afm.request("nothing")

            ask(2000)
            before = resident_kib()
            ask(requests)
            grown = resident_kib() - before
            print(f"{requests} requests: {grown} KiB more than before")
            self.assertLess(grown, 4096)


if __name__ == "__main__":
    unittest.main()
