#!/bin/sh
# The compiler of mutate.py: calls $LAUNCHER (such as ccache) COMPILER ARGUMENT..., for a mutant without warnings.
exec $LAUNCHER "$@" ${HEMITEX_MUTANT:+-w}
