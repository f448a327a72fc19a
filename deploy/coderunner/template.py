# Moodle CodeRunner: the template of a question whose prototype runs Python 3.
# Customise > Template: this file, "Is combinator" ticked; Grader: "Template grader".
# Advanced > Sandbox: memory limit 0 (ggrade bounds itself), time limit 20 seconds, which ends a slow machine's run.
# ggrade and Mesa's software driver are installed on the sandbox server (Jobe).
import html
import json
import os
import subprocess
import sys

ANSWER = """{{ STUDENT_ANSWER | e('py') }}"""
LANGUAGE = "ja"

FAILED = {
    "en": "The autograder failed. It is no fault of your answer.",
    "ja": "採点システムに障害が起きました。解答が原因ではありません。",
}
# CodeRunner cannot leave an answer unmarked: without a fraction it marks 0 all the same, and shows its own error.
NOT_A_MARK = {
    "en": "The 0 shown here is not a mark: the staff grades this attempt again. Please tell them.",
    "ja": "ここに表示される 0 点は採点結果ではありません。担当者が再採点しますので、知らせてください。",
}


def graded():
    with open("ggsample06.vert", "w", encoding="utf-8", newline="") as file:
        file.write(ANSWER)
    ggrade = os.environ.get("GGRADE", "ggrade")
    command = [ggrade, "grade", "ggsample06.vert", "--format", "coderunner", "--lang", LANGUAGE]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return json.loads(done.stdout)  # One object for each of the endings 0, 1, 3 and 4.


try:
    result = graded()
except Exception as error:
    detail = "%s: %s" % (type(error).__name__, error)
    result = {"prologuehtml": "<p>%s</p><p>%s</p>" % (FAILED[LANGUAGE], html.escape(detail))}
if "fraction" not in result:
    result = {"fraction": 0.0, "prologuehtml": "%s<p>%s</p>" % (result["prologuehtml"], NOT_A_MARK[LANGUAGE])}
sys.stdout.write(json.dumps(result) + "\n")
