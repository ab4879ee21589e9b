# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
"""The version of scipd that this package belongs to; a test holds it to that of the project."""

__version__ = "0.1.0"
