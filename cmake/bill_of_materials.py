"""bill_of_materials.py VERSION LIBRARIES.tsv package-lock.json OUT: what a package of Keyline is made
of, as SPDX 2.3: the libraries of cmake/KeylineLibraries.cmake with the versions that are installed, what
the page in the browser is bundled from, and the licences of all.
"""

import hashlib
import json
import re
import subprocess
import sys

# Linked or bundled by parts that are no room: keyline-cad, the Python package.
OF_DOORS = [
    ("Open CASCADE Technology", "libocct-data-exchange-dev", "LGPL-2.1-only WITH OCCT-exception-1.0"),
    ("pybind11", "pybind11-dev", "BSD-3-Clause"),
]


def installed_version(package):
    """What dpkg says; empty where it does not know it."""
    try:
        done = subprocess.run(["dpkg-query", "-W", "-f=${Version}", package], capture_output=True, text=True)
    except FileNotFoundError:
        return ""
    return done.stdout.strip()


def library(name, debian, licence):
    version = installed_version(debian)
    entry = {
        "name": name,
        "SPDXID": "SPDXRef-" + re.sub("[^A-Za-z0-9.-]", "-", debian),
        "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False,
        "licenseConcluded": licence,
        "licenseDeclared": licence,
        "copyrightText": "NOASSERTION",
    }
    if version:
        entry["versionInfo"] = version
        entry["externalRefs"] = [
            {
                "referenceCategory": "PACKAGE-MANAGER",
                "referenceType": "purl",
                "referenceLocator": f"pkg:deb/debian/{debian}@{version}",
            }
        ]
    return entry


def bundled(lock):
    """What the page holds: the packages of the lock that are not for development alone."""
    for path, package in json.load(open(lock))["packages"].items():
        if path and not package.get("dev"):
            name = path.split("node_modules/")[-1]
            entry = library(name, "npm-" + name, package["license"])
            entry["versionInfo"] = package["version"]
            yield entry


def main(version, libraries, lock, out):
    rows = [line.split("\t") for line in open(libraries).read().splitlines()]
    parts = [library(*row) for row in rows] + [library(*row) for row in OF_DOORS] + list(bundled(lock))
    own = library("keyline", "keyline", "Apache-2.0") | {"versionInfo": version}
    own.pop("externalRefs", None)
    digest = hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()
    bill = {
        "spdxVersion": "SPDX-2.3",
        "dataLicense": "CC0-1.0",
        "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"keyline-{version}",
        "documentNamespace": f"urn:keyline:{version}:{digest}",
        # no hour of the clock: the same build gives the same bytes
        "creationInfo": {"created": "1970-01-01T00:00:00Z", "creators": ["Tool: bill_of_materials.py"]},
        "packages": [own, *parts],
        "relationships": [
            {"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": own["SPDXID"]},
            *(
                {"spdxElementId": own["SPDXID"], "relationshipType": "DEPENDS_ON", "relatedSpdxElement": p["SPDXID"]}
                for p in parts
            ),
        ],
    }
    with open(out, "w") as file:
        json.dump(bill, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
