# SPDX-License-Identifier: Apache-2.0
"""No program of another user enters a served microscope: neither by its socket, though the file lets it, nor by the port."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

# Says what a client receives: "refused" where it cannot even connect, "nothing" at the end of the connection.
CLIENT = """
import socket, sys
family, address = (socket.AF_UNIX, sys.argv[1]) if len(sys.argv) == 2 else (socket.AF_INET, ("127.0.0.1", int(sys.argv[2])))
client = socket.socket(family)
client.settimeout(20)
try:
    client.connect(address)
    client.sendall(b'{"do": "hello"}\\n' if family == socket.AF_UNIX else b"Bias.Get".ljust(32, b"\\0") + bytes(4) + b"\\0\\1\\0\\0")
    print("an answer" if client.recv(1) else "nothing")
except PermissionError:
    print("refused")
except (ConnectionResetError, BrokenPipeError):
    print("nothing")
"""


class OtherUser(unittest.TestCase):
    def setUp(self):
        self.assertEqual(os.geteuid(), 0, "only root can be another user: run this test as root")
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        os.chmod(folder, 0o755)
        self.path = os.path.join(folder, "afm.sock")
        self.server = subprocess.Popen([os.environ["TOUCHAFM"], "serve", "--socket", self.path, "--nanonis", "0"],
                                       stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.server.stderr.close)
        self.addCleanup(self.server.wait)
        self.addCleanup(self.server.terminate)
        self.assertIn("listens on", self.server.stderr.readline())
        self.port = re.search(r"port (\d+)", self.server.stderr.readline()).group(1)

    def client(self, *arguments, other):
        somebody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if other else []
        done = subprocess.run([*somebody, sys.executable, "-c", CLIENT, *arguments], capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def test_is_refused_by_the_socket(self):
        self.assertEqual(self.client(self.path, other=True), "refused")
        os.chmod(self.path, 0o666)
        self.assertEqual(self.client(self.path, other=True), "nothing")
        self.assertEqual(self.client(self.path, other=False), "an answer")

    def test_is_refused_by_the_port(self):
        self.assertEqual(self.client("port", self.port, other=True), "nothing")
        self.assertEqual(self.client("port", self.port, other=False), "an answer")


if __name__ == "__main__":
    unittest.main()
