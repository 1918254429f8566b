"""studio_door.py KEYLINE FOLDER: requests as lines of JSON in, what Keyline Studio's server makes of
them as lines of JSON out. The server works in FOLDER, and is asked over one connection."""

import http.client
import json
import os
import subprocess
import sys
import tempfile

TOKEN = "0123456789abcdef"


def answer(connection, request):
    """The answer to one request, in the form of python_door.py."""
    fields = {k: v for k, v in request.items() if k != "op"}
    connection.request("POST", "/api/v1/" + request["op"], json.dumps(fields),
                       {"Authorization": "Bearer " + TOKEN, "Content-Type": "application/json"})
    said = json.loads(connection.getresponse().read())
    return said if said["ok"] else {"ok": False, "message": said["error"]["message"]}


keyline, folder = sys.argv[1:]
with tempfile.TemporaryDirectory() as state:
    with open(os.path.join(state, "index.html"), "w") as page:
        page.write("<!doctype html><title>page</title>")
    server = subprocess.Popen([keyline, "studio", "--no-browser", "--token", TOKEN], cwd=folder,
                              stdout=subprocess.PIPE, text=True,
                              env=dict(os.environ, XDG_STATE_HOME=state, KEYLINE_STUDIO_PAGE=state))
    try:
        port = int(server.stdout.readline().split()[-1].split(":")[2].split("/")[0])
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=900)
        for line in sys.stdin:
            print(json.dumps(answer(connection, json.loads(line))))
    finally:
        server.terminate()
        server.wait(timeout=300)
