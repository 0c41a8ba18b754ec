/* JSON as a tree; nothing is ever freed, as the program is short-lived. */
#pragma once
#include <stdbool.h>
#include <stddef.h>

typedef struct Json Json;
struct Json {
    char kind;        /* 'n' number, 's' string, 'b' bool, '0' null, '[' list, '{' object */
    double number;    /* also 1 for true, and what "inf" means */
    char *string;
    char *key;        /* where it stands in an object */
    Json *first, *next;
};

Json *json_parse(const char *text);
/* The value under a key, NULL where there is none. */
Json *json_get(const Json *object, const char *key);
Json *json_at(const Json *list, size_t index);
size_t json_count(const Json *list);
