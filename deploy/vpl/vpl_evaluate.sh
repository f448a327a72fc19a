#!/bin/bash
# Moodle VPL, "Execution files", vpl_evaluate.sh: makes the program that evaluates one submission.
# ggrade and Mesa's software driver are installed on the execution server (the jail).
#
# GGRADE    the program; ggrade on the PATH unless said otherwise

# VPL's own variables: VPL_GRADEMIN, VPL_GRADEMAX, VPL_LANG.
[ ! -f vpl_environment.sh ] || . ./vpl_environment.sh

# What VPL runs next has none of these variables: they are written into it.
cat >vpl_execution <<END
#!/bin/bash
export VPL_GRADEMIN=$(printf %q "${VPL_GRADEMIN:-}") VPL_GRADEMAX=$(printf %q "${VPL_GRADEMAX:-}")
case $(printf %q "${VPL_LANG:-en}") in ja*) export GGRADE_LANG=ja ;; *) export GGRADE_LANG=en ;; esac
$(printf %q "${GGRADE:-ggrade}") grade ggsample06.vert --format vpl
END
cat >>vpl_execution <<'END'
code=$?
# 0 and 1 graded, 3 our fault, 4 nothing to grade: each has been told above. No grade is proposed otherwise.
case $code in
0 | 1 | 3 | 4) ;;
*) echo "Comment :=>> ggrade ended with $code; no grade is proposed, and no point is lost. Please tell the staff." ;;
esac
END
chmod +x vpl_execution
