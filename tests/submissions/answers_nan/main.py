"""Answers with NaN in three spellings, and with something that is no JSON."""

import json

import honest

BAD = {"none": '"nan"', "square": "NaN", "clamped": "null"}


def probe(questions):
    for question in questions:
        name = question["id"].rsplit("/", 1)[1]
        if name in BAD:
            print('{"id":%s,"value":%s}' % (json.dumps(question["id"]), BAD[name]), flush=True)
        else:
            print("{" + honest.reply(question), flush=True)


honest.main(probe=probe)
