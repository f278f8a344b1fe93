# SPDX-License-Identifier: Apache-2.0
"""No program of another user enters a served microscope: neither by its socket, though the file lets it, nor by the port."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

# Says what a client receives: "refused" where it cannot even connect, "nothing" at the end of the connection. It becomes the other user
# once all is loaded, and names the socket from its folder: on some systems no other user can enter the root folder.
CLIENT = """
import os, socket, sys
user, folder, address = int(sys.argv[1]), sys.argv[2], sys.argv[3]
os.chdir(folder)
if user:
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
port = address.isdigit()
client = socket.socket(socket.AF_INET if port else socket.AF_UNIX)
client.settimeout(20)
try:
    client.connect(("127.0.0.1", int(address)) if port else address)
    client.sendall(b"Bias.Get".ljust(32, b"\\0") + bytes(4) + b"\\0\\1\\0\\0" if port else b'{"do": "hello"}\\n')
    print("an answer" if client.recv(1) else "nothing")
except PermissionError:
    print("refused")
except (ConnectionResetError, BrokenPipeError):
    print("nothing")
"""
NOBODY = 65534


class OtherUser(unittest.TestCase):
    def setUp(self):
        self.assertEqual(os.geteuid(), 0, "only root can be another user: run this test as root")
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        os.chmod(self.folder, 0o755)
        self.path = os.path.join(self.folder, "afm.sock")
        self.server = subprocess.Popen([os.environ["TOUCHAFM"], "serve", "--socket", self.path, "--nanonis", "0"],
                                       stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.server.stderr.close)
        self.addCleanup(self.server.wait)
        self.addCleanup(self.server.terminate)
        self.assertIn("listens on", self.server.stderr.readline())
        self.port = re.search(r"port (\d+)", self.server.stderr.readline()).group(1)

    def client(self, address, other):
        arguments = [str(NOBODY if other else 0), self.folder, address]
        done = subprocess.run([sys.executable, "-c", CLIENT, *arguments], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def test_is_refused_by_the_socket(self):
        self.assertEqual(self.client("afm.sock", other=True), "refused")
        os.chmod(self.path, 0o666)
        self.assertEqual(self.client("afm.sock", other=True), "nothing")
        self.assertEqual(self.client("afm.sock", other=False), "an answer")

    def test_is_refused_by_the_port(self):
        self.assertEqual(self.client(self.port, other=True), "nothing")
        self.assertEqual(self.client(self.port, other=False), "an answer")


if __name__ == "__main__":
    unittest.main()
