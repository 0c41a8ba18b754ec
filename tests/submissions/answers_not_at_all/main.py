"""Passes over one question."""

import honest


def probe(questions):
    for question in questions:
        if not question["id"].endswith("square"):
            print(honest.reply(question), flush=True)


honest.main(probe=probe)
