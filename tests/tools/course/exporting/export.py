"""./course export."""

import sys

from exporting.weights_table import print_weights


def export(arguments) -> int:
    return print_weights(sys.stdout)
