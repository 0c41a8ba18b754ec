"""Writes the right pictures and ends with 1."""

import sys

import honest

honest.main()
sys.exit(1)
