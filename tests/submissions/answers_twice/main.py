"""Answers one question twice, wrong and then right."""

import json

import honest


def probe(questions):
    for question in questions:
        if question["id"].endswith("square"):
            print(json.dumps({"id": question["id"], "value": 7}))
        print(honest.reply(question), flush=True)


honest.main(probe=probe)
