"""Keyline Studio's server started for a test: KEYLINE SOURCE EARLY are the test's arguments, EARLY a
library that starts a thread before main."""
import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

KEYLINE, SOURCE, EARLY = sys.argv[1:4]
TOKEN = "0123456789abcdef"
PATIENCE = 300  # seconds: how fast the machine is, is not what is asked
# Of an address sanitizer, if there is one: what is freed is not kept, for memory is measured, and a
# library may be loaded before it.
SANITIZER = "quarantine_size_mb=1:thread_local_quarantine_size_kb=16:verify_asan_link_order=0"
SEGMENT = {"points": [[0, 0], [2, 0], [3, 1.5]], "alpha": -1}


class Server:
    def __init__(self, *arguments, folder=SOURCE, **surroundings):
        self.state = tempfile.TemporaryDirectory()
        page = os.path.join(self.state.name, "page")
        os.mkdir(page)
        with open(os.path.join(page, "index.html"), "w") as f:
            f.write("<!doctype html><title>page</title>")
        environment = dict(os.environ, XDG_STATE_HOME=self.state.name, KEYLINE_STUDIO_PAGE=page,
                           ASAN_OPTIONS=SANITIZER, **surroundings)
        self.log = open(os.path.join(self.state.name, "log"), "w+")
        self.process = subprocess.Popen(
            [KEYLINE, "studio", "--no-browser", "--token", TOKEN, *arguments], cwd=folder,
            stdout=subprocess.PIPE, stderr=self.log, text=True, env=environment)
        self.url = self.process.stdout.readline().split()[-1]
        self.port = int(self.url.split(":")[2].split("/")[0])

    def connection(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)

    def ask(self, method, path, body=None, connection=None, **headers):
        c = connection or self.connection()
        headers = {"Authorization": "Bearer " + TOKEN, "Content-Type": "application/json",
                   **{k.replace("_", "-"): v for k, v in headers.items()}}
        c.request(method, path, body if body is None or isinstance(body, (bytes, str))
                  else json.dumps(body), {k: v for k, v in headers.items() if v is not None})
        reply = c.getresponse()
        body = reply.read()
        if connection is None:
            c.close()
        return reply.status, body, reply

    def raw(self, data, wait=5.0):
        with socket.create_connection(("127.0.0.1", self.port), timeout=wait) as s:
            s.sendall(data)
            s.shutdown(socket.SHUT_WR)
            received = b""
            try:
                while chunk := s.recv(65536):
                    received += chunk
            except (ConnectionResetError, socket.timeout):
                pass
            return received

    def memory(self):
        with open(f"/proc/{self.process.pid}/status") as f:
            return next(int(line.split()[1]) for line in f if line.startswith("VmRSS"))

    def busy(self):
        with open(f"/proc/{self.process.pid}/stat") as f:
            fields = f.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def logged(self):
        self.log.flush()
        with open(self.log.name) as f:
            return f.read()

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
        status = self.process.wait(timeout=20)
        self.process.stdout.close()
        self.log.close()
        self.state.cleanup()
        return status


class ServerTest(unittest.TestCase):
    """Tests that share a server, which is to be well after each and to end when told."""

    @classmethod
    def setUpClass(cls):
        cls.server = Server()

    @classmethod
    def tearDownClass(cls):
        assert cls.server.stop() == 0

    def ask(self, *arguments, **headers):
        return self.server.ask(*arguments, **headers)

    def well(self):
        status, body, _ = self.ask("POST", "/api/v1/lac.segment", SEGMENT)
        self.assertEqual(status, 200)
        self.assertTrue(json.loads(body)["ok"])
