"""Right in everything: the control of all the others."""

import honest

honest.main()
