"""server_load_test.py KEYLINE SOURCE: what Keyline Studio's server bears: slow clients, crowds, hours."""
import concurrent.futures
import json
import os
import random
import socket
import subprocess
import sys
import time
import unittest

from studio_server import KEYLINE, SEGMENT, TOKEN, ServerTest


class StudioLoad(ServerTest):
    def test_is_unharmed_by_slow_clients(self):
        slow = [socket.create_connection(("127.0.0.1", self.server.port)) for _ in range(300)]
        for s in slow:
            s.sendall(b"POST /api/v1/lac.segment HTTP/1.1\r\nHost: 127")
        began = time.time()
        for _ in range(20):
            self.well()
        self.assertLess(time.time() - began, 5)
        for s in slow:
            s.close()

    def test_shows_slow_clients_out(self):
        """Bytes that come one by one do not hold a connection: 20 s for a request's first lines,
        60 s for its body. In the full tier alone: it waits for both."""
        if not os.environ.get("KEYLINE_FULL"):
            self.skipTest("KEYLINE_FULL is not set")
        head = (f"POST /api/v1/lac.segment HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\n"
                f"Authorization: Bearer {TOKEN}\r\nContent-Type: application/json\r\n")
        for started, least, most in ((head, 15, 30), (head + "Content-Length: 1000\r\n\r\n{", 50, 75)):
            with socket.create_connection(("127.0.0.1", self.server.port), timeout=0.5) as s:
                s.sendall(started.encode())
                began, ended = time.time(), None
                while ended is None and time.time() - began < most + 5:
                    try:
                        s.sendall(b" ")
                        s.recv(1000)  # a refusal, or the end
                        ended = time.time()
                    except socket.timeout:
                        pass
                    except OSError:
                        ended = time.time()
                self.assertIsNotNone(ended)
                self.assertGreater(ended - began, least)
                self.assertLess(ended - began, most)
        self.well()

    def test_bears_a_crowd(self):
        """100 clients of many requests each: none lost, memory flat."""
        clients, requests = 100, 1000 if os.environ.get("KEYLINE_FULL") else 60

        def client(number):
            connection, waits = self.server.connection(), []
            for i in range(requests):
                asked = dict(SEGMENT, alpha=-1 + (number + i) % 5 / 10)
                began = time.time()
                status, body, _ = self.server.ask("POST", "/api/v1/lac.segment", asked,
                                                  connection=connection)
                waits.append(time.time() - began)
                if status != 200 or not json.loads(body)["ok"]:
                    return None
            connection.close()
            return waits

        def crowd():
            with concurrent.futures.ThreadPoolExecutor(clients) as pool:
                return list(pool.map(client, range(clients)))

        crowd()
        before = self.server.memory()
        answered = crowd()
        self.assertNotIn(None, answered)
        waits = sorted(w for list_ in answered for w in list_)
        after = self.server.memory()
        print(f"{len(waits)} requests of {clients} clients: p50 {1e3 * waits[len(waits) // 2]:.1f} "
              f"ms, p99 {1e3 * waits[len(waits) * 99 // 100]:.1f} ms, memory {before} -> {after} kB",
              file=sys.stderr)
        self.assertLess(after, before + 20000)

    def test_works_for_an_hour(self):
        """Random operations, right and wrong, one after the other: none ends the server, no leak.
        An hour's worth (6,000 at a hand's pace) in the full tier, a minute's in the default one."""
        dice = random.Random(5)
        examples = self.examples()
        connection = self.server.connection()
        rounds = 6000 if os.environ.get("KEYLINE_FULL") else 150

        def ask_some(count):
            for _ in range(count):
                name, request = dice.choice(examples)
                request = dict(request)
                if dice.random() < 0.3 and request:  # spoilt
                    key = dice.choice(list(request))
                    request[key] = dice.choice([None, -1, "x", [], {}, 1e308, [[0, 0]]])
                status, body, _ = self.server.ask("POST", "/api/v1/" + name, request,
                                                  connection=connection)
                answered = json.loads(body)
                self.assertEqual(answered["ok"], status == 200, body[:200])
                if not answered["ok"]:
                    self.assertNotEqual(answered["error"]["code"], "internal", (name, request))

        ask_some(rounds // 2)
        before = self.server.memory()
        ask_some(rounds // 2)
        after = self.server.memory()
        connection.close()
        print(f"{rounds} random operations: memory {before} -> {after} kB", file=sys.stderr)
        self.assertLess(after, before + 40000)
        self.well()

    def examples(self):
        """Of every operation that reads and writes no files and is quick."""
        _, body, _ = self.ask("GET", "/api/v1/operations")
        listed = json.loads(body)["operations"]
        found = []
        for operation in listed:
            if operation["reads_files"] or operation["writes_files"] or operation["name"] == "fit.spline":
                continue
            schema = subprocess.run([KEYLINE, "operations", operation["name"]], capture_output=True,
                                    text=True)
            for example in json.loads(schema.stdout).get("examples", []):
                example.pop("op", None)
                found.append((operation["name"], example))
        return found


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
