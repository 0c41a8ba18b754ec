#!/usr/bin/python3
"""A script whose first line ends as lines do on Windows: no interpreter has that name."""

import honest

honest.main()
