"""Answers all questions, last one first."""

import honest


def probe(questions):
    for question in reversed(list(questions)):
        print(honest.reply(question), flush=True)


honest.main(probe=probe)
