#include "json.h"
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void skip(const char **at) {
    while (isspace((unsigned char)**at) || **at == ',' || **at == ':') ++*at;
}

static char *string(const char **at) {
    const char *start = ++*at;
    while (**at != '"') *at += **at == '\\' ? 2 : 1;
    size_t length = (size_t)(*at - start);
    char *copy = calloc(length + 1, 1);
    memcpy(copy, start, length);
    ++*at;
    return copy;
}

static Json *value(const char **at) {
    skip(at);
    Json *json = calloc(1, sizeof *json);
    if (**at == '{' || **at == '[') {
        json->kind = **at;
        char end = **at == '{' ? '}' : ']';
        Json **last = &json->first;
        for (++*at, skip(at); **at != end; skip(at)) {
            char *key = NULL;
            if (json->kind == '{') key = string(at);
            *last = value(at);
            (*last)->key = key;
            last = &(*last)->next;
        }
        ++*at;
    } else if (**at == '"') {
        json->kind = 's';
        json->string = string(at);
        if (!strcmp(json->string, "inf")) json->number = INFINITY;
        if (!strcmp(json->string, "-inf")) json->number = -INFINITY;
    } else if (isalpha((unsigned char)**at)) {
        json->kind = **at == 'n' ? '0' : 'b';
        json->number = **at == 't';
        while (isalpha((unsigned char)**at)) ++*at;
    } else {
        char *end;
        json->kind = 'n';
        json->number = strtod(*at, &end);
        if (end == *at) exit(2);
        *at = end;
    }
    return json;
}

Json *json_parse(const char *text) { return value(&text); }

Json *json_get(const Json *object, const char *key) {
    if (!object || object->kind != '{') return NULL;
    for (Json *one = object->first; one; one = one->next)
        if (!strcmp(one->key, key)) return one;
    return NULL;
}

Json *json_at(const Json *list, size_t index) {
    Json *one = list->first;
    while (one && index--) one = one->next;
    return one;
}

size_t json_count(const Json *list) {
    size_t n = 0;
    for (const Json *one = list->first; one; one = one->next) n++;
    return n;
}
