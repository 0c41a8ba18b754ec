"""Gives two answers in one reply, an endless line to the next question, and says that it does not miss."""

import json

import honest


def probe(questions):
    for question in questions:
        reply = json.loads(honest.reply(question))
        if question["id"].endswith("square"):
            reply["miss"] = True
        if question["id"].endswith("clamped"):
            reply["note"] = [0] * 1_000_000
        if question["id"].endswith("linear"):
            reply = {"id": question["id"], "miss": False}
        print(json.dumps(reply), flush=True)


honest.main(probe=probe)
