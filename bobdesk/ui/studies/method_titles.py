"""What a person calls the methods."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

from bobdesk.files.solvers import solver_methods


def method_titles() -> dict[str, str]:
    """Return the methods' names by key: the program's own, then those of plug-ins."""
    own = {
        "pgd": QCoreApplication.translate("MethodTitles", "Projected gradient (recommended)"),
        "published": QCoreApplication.translate("MethodTitles", "As published"),
        "lbfgsb": "L-BFGS-B",
        "slsqp": "SLSQP",
        "trustconstr": "trust-constr",
        "de": QCoreApplication.translate("MethodTitles", "Differential evolution"),
    }
    return {method.key: own.get(method.key, method.title) for method in solver_methods().formats}
