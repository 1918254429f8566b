"""server_test.py KEYLINE SOURCE: Keyline Studio's server as seen from outside."""
import http.client
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from urllib.parse import quote

from studio_server import EARLY, KEYLINE, PATIENCE, SEGMENT, SOURCE, TOKEN, Server, ServerTest


class StudioServer(ServerTest):
    def test_answers_as_the_command_line_does(self):
        lines = [{"op": "lac.segment", **SEGMENT},
                 {"op": "lac.region", "theta": 1, "alpha": -1},
                 {"op": "lac.segment", "points": [[0, 0], [1, 0], [-5, 0.1]], "alpha": 1},
                 {"op": "lac.segment", "points": [[0, 0]], "alpha": 1}]
        batch = subprocess.run([KEYLINE, "batch", "--quiet"], capture_output=True, text=True,
                               input="".join(json.dumps(line) + "\n" for line in lines))
        for line, answer in zip(lines, batch.stdout.splitlines()):
            request = {k: v for k, v in line.items() if k != "op"}
            _, body, _ = self.ask("POST", "/api/v1/" + line["op"], request)
            want = json.loads(answer)
            del want["id"]
            self.assertEqual(json.dumps(json.loads(body), sort_keys=True),
                             json.dumps(want, sort_keys=True))

    def test_lists_what_can_be_asked(self):
        status, body, _ = self.ask("GET", "/api/v1/operations")
        names = [o["name"] for o in json.loads(body)["operations"]]
        self.assertEqual(status, 200)
        self.assertIn("fair", names)
        status, body, _ = self.ask("GET", "/api/v1/openapi.json")
        self.assertIn("/api/v1/fair", json.loads(body)["paths"])

    def test_tells_how_far_long_work_is(self):
        points = [[i / 10, (i / 10) ** 2 / 5] for i in range(30)]
        _, body, reply = self.ask("POST", "/api/v1/fair", {"points": points},
                                  Accept="text/event-stream")
        self.assertEqual(reply.getheader("Content-Type"), "text/event-stream")
        events = [e.split("\n") for e in body.decode().strip().split("\n\n")]
        names = [e[0] for e in events]
        self.assertGreater(names.count("event: progress"), 1)
        self.assertEqual(names[-1], "event: answer")
        self.assertTrue(json.loads(events[-1][1].removeprefix("data: "))["ok"])

    def long_work(self):
        import random
        dice = random.Random(3)
        return {"points": [[i, 8 * ((i * 7919) % 13) / 13 + dice.random()] for i in range(900)],
                "tolerance": 0.01, "trials": 1000, "keep_order": True}

    def test_ends_work_that_is_cancelled_and_drags_meanwhile(self):
        answer = {}

        def work():
            began = time.time()
            answer["status"], answer["body"], _ = self.ask(
                "POST", "/api/v1/fair", self.long_work(), Keyline_Job="mine")
            answer["seconds"] = time.time() - began

        thread = threading.Thread(target=work)
        thread.start()
        self.addCleanup(lambda: self.ask("POST", "/api/v1/cancel", {"job": "mine"}))
        time.sleep(1)
        connection = self.server.connection()
        waits = []
        for _ in range(100):
            began = time.time()
            self.server.ask("POST", "/api/v1/lac.segment", SEGMENT, connection=connection)
            waits.append(time.time() - began)
        connection.close()
        _, body, _ = self.ask("POST", "/api/v1/cancel", {"job": "mine"})
        self.assertTrue(json.loads(body)["found"])
        thread.join(PATIENCE)  # it goes on behind everything else the machine does
        self.assertFalse(thread.is_alive())
        if "KEYLINE_TIMING" in os.environ:
            self.assertLess(sorted(waits)[94], 0.05)
        answered = json.loads(answer["body"])
        self.assertTrue(answered.get("result", {}).get("cancelled")
                        or answered["error"]["code"] == "cancelled", answer["body"][:300])

    def test_ends_work_that_was_cancelled_before_it_came(self):
        # Two connections of one page: which request comes first is chance.
        self.ask("POST", "/api/v1/cancel", {"job": "early"})
        _, body, _ = self.ask("POST", "/api/v1/fair", self.long_work(), Keyline_Job="early")
        answered = json.loads(body)
        self.assertTrue(answered.get("result", {}).get("cancelled")
                        or answered["error"]["code"] == "cancelled", body[:300])

    def test_ends_work_nobody_waits_for(self):
        with socket.create_connection(("127.0.0.1", self.server.port)) as s:
            body = json.dumps(self.long_work())
            s.sendall((f"POST /api/v1/fair HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\n"
                       f"Authorization: Bearer {TOKEN}\r\nContent-Type: application/json\r\n"
                       f"Content-Length: {len(body)}\r\nKeyline-Job: left\r\n\r\n{body}").encode())
            time.sleep(0.5)
        left = self.server.busy()
        idle = 0
        while idle < 5:  # it may wait for a busy machine, too
            before = self.server.busy()
            self.assertLess(before - left, 15, "the work goes on")  # seconds of the processor
            time.sleep(0.2)
            idle = idle + 1 if self.server.busy() == before else 0

    def test_reads_files_of_its_folder_alone(self):
        status, body, _ = self.ask("POST", "/api/v1/document.read", {"file": "examples/cubic.json"})
        self.assertEqual(status, 200, body)
        for name in ("/etc/passwd", "../../etc/passwd", "examples/../../x", "/proc/self/environ"):
            status, body, _ = self.ask("POST", "/api/v1/document.read", {"file": name})
            self.assertEqual(status, 400, name)
            self.assertIn("outside", json.loads(body)["error"]["message"])
        for path in ("/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..%2f..%2fetc/passwd",
                     "//etc/passwd", "/index.html/../../etc/passwd", "/\\..\\etc"):
            status, body, _ = self.ask("GET", path)
            self.assertEqual(status, 404, path)
            self.assertNotIn(b"root:", body)

    def test_takes_a_file_that_is_dropped(self):
        with open(os.path.join(SOURCE, "examples/cubic.json"), "rb") as f:
            content = f.read()
        _, body, _ = self.ask("POST", "/api/v1/studio/upload?name=..%2Fa%20b.json", content)
        file = json.loads(body)["file"]
        self.assertTrue(file.endswith("/a b.json"))
        status, body, _ = self.ask("POST", "/api/v1/document.read", {"file": file})
        self.assertEqual(len(json.loads(body)["result"]["curves"]), 1)

    def test_gives_the_files_it_was_given_and_no_others(self):
        with open(os.path.join(SOURCE, "examples/sketch.png"), "rb") as f:
            content = f.read()
        started = Server("examples/sketch.png")
        self.addCleanup(started.stop)
        path = "/api/v1/studio/file?name="
        status, body, _ = started.ask("GET", path + "examples/sketch.png")
        self.assertEqual((status, body), (200, content))
        _, body, _ = started.ask("POST", "/api/v1/studio/upload?name=a.png", content)
        status, body, _ = started.ask("GET", path + quote(json.loads(body)["file"]))
        self.assertEqual((status, body), (200, content))
        for name, why in (("examples/roof.csv", "not given"), ("examples", "not given"),
                          ("/etc/passwd", "outside"), ("examples/../../x", "outside"), ("", "")):
            status, body, _ = started.ask("GET", path + name)
            self.assertEqual(status, 400, name)
            self.assertIn(why, json.loads(body)["error"]["message"])
        status, body, _ = started.ask("GET", path + "examples/sketch.png", Authorization=None)
        self.assertEqual(status, 401)

    def test_exports_what_reads_back(self):
        _, body, _ = self.ask("POST", "/api/v1/lac.segment", SEGMENT)
        curve = json.loads(body)["result"]["curve"]
        for form in ("json", "svg", "dxf", "step", "iges", "csv"):
            status, body, reply = self.ask("POST", "/api/v1/studio/export", {
                "file": "x." + form, "unit": "mm", "curves": [{"name": "a", "curve": curve}]})
            if status == 400 and form in ("step", "iges"):
                continue  # built without
            self.assertEqual(status, 200, body)
            self.assertGreaterEqual(float(reply.getheader("Keyline-Deviation")), 0)
            _, kept, _ = self.ask("POST", f"/api/v1/studio/upload?name=x.{form}", body)
            status, body, _ = self.ask("POST", "/api/v1/document.read",
                                       {"file": json.loads(kept)["file"]})
            self.assertEqual(status, 200, body)
            self.assertEqual(len(json.loads(body)["result"]["curves"]), 1, form)

    def test_exports_pictures_and_pages(self):
        _, body, _ = self.ask("POST", "/api/v1/lac.segment", SEGMENT)
        curves = [{"name": "a", "curve": json.loads(body)["result"]["curve"]}]
        for form, head in (("pdf", b"%PDF"), ("png", b"\x89PNG"), ("html", b"<!doctype html>")):
            status, body, _ = self.ask("POST", "/api/v1/studio/export",
                                       {"file": "x." + form, "unit": "mm", "curves": curves})
            self.assertEqual(status, 200, body[:300])
            self.assertEqual(body[:len(head)].lower(), head.lower())
        for wrong in ({}, {"file": 3}, {"file": "x.nothing"}, {"file": "x.svg", "curves": 3},
                      {"file": "x.svg", "curves": [{"curve": {}}]}, []):
            status, body, _ = self.ask("POST", "/api/v1/studio/export", wrong)
            self.assertEqual(status, 400, (wrong, body[:300]))
        self.well()

    def test_exports_the_report_of_what_was_done(self):
        points = [[i, (i - 30) ** 2 / 60 + 0.01 * ((i * 7919) % 13)] for i in range(61)]
        told = [{"op": "fair", "name": "bow", "request": {"points": points}}]
        _, body, _ = self.ask("POST", "/api/v1/fair", {"points": points})
        fair = json.loads(body)["result"]
        status, body, _ = self.ask("POST", "/api/v1/studio/export?report=1",
                                   {"file": "x.html", "unit": "mm", "report": told})
        self.assertEqual(status, 200, body[:300])
        page = body.decode()
        self.assertTrue("class=\"explorer\"" in page)
        self.assertTrue(f"<dd class=\"value\">{len(fair['pieces'])}</dd>" in page)
        curve = fair["curve"]
        status, body, _ = self.ask("POST", "/api/v1/studio/export", {
            "file": "x.html", "report": [{"op": "curve.analyze", "request": {"curve": curve}}]})
        self.assertEqual(status, 200, body[:300])
        self.assertTrue(b"<h1>Curve analysis</h1>" in body)
        for wrong in (3, [], [3], [{}], [{"op": "convert"}], [{"op": "document.read"}], told + [{}],
                      [{"op": "fair", "request": {"points": 3}}], [{"op": "fair", "name": 3}]):
            status, body, _ = self.ask("POST", "/api/v1/studio/export",
                                       {"file": "x.html", "report": wrong})
            self.assertEqual(status, 400, (wrong, body[:300]))
        self.well()

    def test_refuses_who_may_not_ask(self):
        refused = [
            ({"Host": "evil.example"}, 421), ({"Origin": "http://evil.example"}, 403),
            ({"Sec_Fetch_Site": "cross-site"}, 403), ({"Authorization": None}, 401),
            ({"Authorization": "Bearer 0123456789abcdee"}, 401)]
        for headers, want in refused:
            status, _, _ = self.ask("POST", "/api/v1/lac.segment", SEGMENT, **headers)
            self.assertEqual(status, want, headers)
        status, _, _ = self.ask("OPTIONS", "/api/v1/lac.segment", Origin="http://evil.example")
        self.assertEqual(status, 403)
        status, _, _ = self.ask("POST", "/api/v1/lac.segment", SEGMENT, Content_Type="text/plain")
        self.assertEqual(status, 400)
        log = self.server.logged()
        for reason in ("evil.example", "another site", "token"):
            self.assertIn(reason, log)
        self.well()

    def test_survives_what_is_no_request(self):
        host = f"Host: 127.0.0.1:{self.server.port}\r\nAuthorization: Bearer {TOKEN}\r\n"
        head = "POST /api/v1/lac.segment HTTP/1.1\r\n" + host
        for data in (b"\x00\x01\x02\x03\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n",
                     (head + "Content-Length: -5\r\n\r\n").encode(),
                     (head + "Content-Length: 99999999999999999999\r\n\r\n").encode(),
                     (head + "Transfer-Encoding: chunked\r\n\r\nZZ\r\n").encode(),
                     (head + "X: " + "a" * 100000 + "\r\n\r\n").encode(),
                     b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n"):
            reply = self.server.raw(data)
            self.assertRegex(reply[:13], rb"^(HTTP/1.1 4..|)", data[:60])
        status, _, _ = self.ask("POST", "/api/v1/lac.segment", b"[" * 100000)
        self.assertEqual(status, 400)
        status, _, _ = self.ask("POST", "/api/v1/lac.segment", b'{"points":')
        self.assertEqual(status, 400)
        self.well()

    def test_refuses_bodies_that_are_too_large(self):
        head = (f"POST /api/v1/lac.segment HTTP/1.1\r\nHost: 127.0.0.1:{self.server.port}\r\n"
                f"Authorization: Bearer {TOKEN}\r\nContent-Type: application/json\r\n"
                f"Content-Length: {80 << 20}\r\n\r\n").encode()
        self.assertIn(b" 413 ", self.server.raw(head + b"x" * 1000)[:40])
        self.well()

    def test_keeps_the_work(self):
        text = json.dumps({"format": "keyline-studio", "x": "\u00e4"})
        self.assertEqual(self.ask("POST", "/api/v1/studio/recovery", text)[0], 200)
        self.assertEqual(self.ask("GET", "/api/v1/studio/recovery")[1].decode(), text)

    def test_page_has_a_strict_policy(self):
        status, body, reply = self.ask("GET", "/", Authorization=None)
        self.assertEqual(status, 200)
        self.assertIn(b"page", body)
        policy = reply.getheader("Content-Security-Policy")
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)

class StudioStart(unittest.TestCase):
    def refused(self, *arguments):
        r = subprocess.run([KEYLINE, "studio", "--no-browser", *arguments], capture_output=True,
                           text=True, timeout=20)
        self.assertTrue(r.stderr.startswith("keyline: "), r.stderr)
        self.assertEqual(r.stderr.count("\n"), 1)
        return r.returncode

    def test_refuses_what_cannot_be(self):
        self.assertEqual(self.refused("no-such-file.csv"), 3)
        self.assertEqual(self.refused("--listen", "0.0.0.0"), 2)
        self.assertEqual(self.refused("--token", "short"), 2)
        self.assertEqual(self.refused("--no-such-option"), 2)

    def test_a_team_reaches_it_by_its_name(self):
        server = Server("--listen", "127.0.0.1", "--host", "keyline.example")
        try:
            status, _, _ = server.ask("GET", "/api/v1/operations", Host="keyline.example")
            self.assertEqual(status, 200)
        finally:
            self.assertEqual(server.stop(), 0)

    def test_ends_in_order_whatever_thread_is_told(self):
        for told in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(told=told):
                server = Server(LD_PRELOAD=EARLY)
                server.process.send_signal(told)
                self.assertEqual(server.stop(), 0)

    def test_ends_when_told_even_at_work(self):
        server = Server()
        body = json.dumps({"points": [[i, (i * 7919) % 13] for i in range(600)], "trials": 1000})
        threading.Thread(target=lambda: self.try_ask(server, body), daemon=True).start()
        time.sleep(0.7)
        began = time.time()
        self.assertEqual(server.stop(), 0)
        self.assertLess(time.time() - began, 10)

    def test_does_not_wait_for_who_asks_nothing(self):
        server = Server()
        idle = server.connection()
        server.ask("GET", "/api/v1/operations", connection=idle)
        clock = threading.Timer(1.5, server.process.kill)
        clock.start()
        self.assertEqual(server.stop(), 0)
        clock.cancel()

    @staticmethod
    def try_ask(server, body):
        try:
            server.ask("POST", "/api/v1/fair", body)
        except (ConnectionError, http.client.HTTPException):
            pass


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
