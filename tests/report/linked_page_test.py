"""linked_page_test.py KEYLINE SOURCE: what a report's page lets run, and what it draws from."""
import base64
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

KEYLINE, SOURCE = sys.argv[1], sys.argv[2]
XHTML = "{http://www.w3.org/1999/xhtml}"


def page_of(*command):
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "page.html")
        subprocess.run([KEYLINE, *command, "-o", file, "--quiet"], check=True, timeout=300)
        with open(file, encoding="utf-8") as f:
            return f.read()


class LinkedPage(unittest.TestCase):
    def check_script(self, page):
        """One script, the one whose hash the policy names."""
        policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
        scripts = re.findall(r"<script>(.*?)</script>", page, re.S)
        self.assertEqual(len(scripts), 1)
        digest = base64.b64encode(hashlib.sha256(scripts[0].encode()).digest()).decode()
        self.assertIn(f"script-src 'sha256-{digest}'", policy)
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe-inline", policy.split("script-src")[1])
        ElementTree.fromstring(page.encode())  # well-formed, the script's marked section too

    def numbers_in(self, page):
        return json.loads(re.search(r'<script type="application/json">(.*?)</script>', page, re.S)[1])

    def test_fairing(self):
        page = page_of("fair", os.path.join(SOURCE, "examples/bonnet-scan.csv"))
        self.check_script(page)
        numbers = self.numbers_in(page)
        sizes = {len(numbers[name]) for name in "skxya"}
        self.assertEqual(len(sizes), 1)
        self.assertEqual(numbers["s"], sorted(numbers["s"]))
        self.assertEqual((numbers["x"][0], numbers["y"][0]), (0, 0))
        # points stand as far apart as their arc lengths say: no number belongs to another place
        for i in range(1, len(numbers["s"])):
            step = numbers["s"][i] - numbers["s"][i - 1]
            chord = ((numbers["x"][i] - numbers["x"][i - 1]) ** 2
                     + (numbers["y"][i] - numbers["y"][i - 1]) ** 2) ** 0.5
            self.assertAlmostEqual(chord, step, delta=1e-3 * step + 2e-6 * numbers["s"][-1])
        told = ElementTree.fromstring(page.encode()).findall(f".//{XHTML}div[@class='explorer']/{XHTML}ul/{XHTML}li")
        self.assertEqual(len(told), len(numbers["joints"]) + 1)
        self.assertGreater(len(numbers["before"]["s"]), 100)
        self.assertEqual(page.count("still"), 2 + page.count(".still"))

    def test_analysis(self):
        self.check_script(page_of("analyze", os.path.join(SOURCE, "examples/cubic.json")))

    def test_without_a_curve_nothing_may_run(self):
        page = page_of("convert", os.path.join(SOURCE, "examples/cubic.json"))
        self.assertNotIn("<script", page)
        self.assertNotIn("script-src", page)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
