# Moodle CodeRunner: the template of a question whose prototype runs Python 3.
# Customise > Template: this file, "Is combinator" ticked; Grader: "Template grader".
# Advanced > Sandbox: memory limit 0 (ggrade bounds itself), time limit 20 seconds.
# ggrade and Mesa's software driver are installed on the sandbox server (Jobe).
import json
import os
import subprocess
import sys

ANSWER = """{{ STUDENT_ANSWER | e('py') }}"""
LANGUAGE = "ja"


def graded():
    with open("ggsample06.vert", "w", encoding="utf-8", newline="") as file:
        file.write(ANSWER)
    ggrade = os.environ.get("GGRADE", "ggrade")
    command = [ggrade, "grade", "ggsample06.vert", "--format", "coderunner", "--lang", LANGUAGE]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=15)
    json.loads(done.stdout)  # One object for each of the endings 0, 1, 3 and 4.
    return done.stdout.decode("utf-8")


try:
    sys.stdout.write(graded())
except Exception as error:
    # Without a fraction: CodeRunner takes it for a failure of the grader, and marks nothing.
    print(json.dumps({"prologuehtml": "<p>The autograder failed (%s). It costs no points.</p>" % type(error).__name__}))
