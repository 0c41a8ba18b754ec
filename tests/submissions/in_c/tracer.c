/* Right in C, for the exam of flat colours: reads what it needs of the JSON by its keys. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char text[1 << 20];

static double number(const char *from, const char *key) {
    const char *at = strstr(from, key);
    return at ? strtod(at + strlen(key), NULL) : 0;
}

static int render(const char *scene, const char *out) {
    FILE *file = fopen(scene, "r");
    if (!file) return 2;
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
    int width = (int)number(text, "\"width\":"), height = (int)number(text, "\"height\":");
    char *at = strchr(strstr(text, "\"background\""), '[') + 1;
    float light[3];
    for (int i = 0; i < 3; i++) {
        light[i] = strtof(at, &at);
        at += strcspn(at, "0123456789]-");
    }
    file = fopen(out, "wb");
    if (!file) return 2;
    fprintf(file, "PF\n%d %d\n-1.0\n", width, height);
    for (int i = 0; i < width * height; i++) fwrite(light, sizeof *light, 3, file);
    return fclose(file) == 0 ? 0 : 2;
}

static int probe(void) {
    while (fgets(text, sizeof text, stdin)) {
        char *id = strstr(text, "\"id\":\"") + 6;
        double a = number(text, "\"quadratic\":"), b = number(text, "\"linear\":"), c = number(text, "\"constant\":");
        double r = number(text, "\"r\":");
        double weakened = 1 / (a * r * r + b * r + c);
        printf("{\"id\":\"%.*s\",\"value\":%.17g}\n", (int)strcspn(id, "\""), id, weakened < 1 ? weakened : 1);
        fflush(stdout);
    }
    return 0;
}

int main(int argc, char **argv) {
    return argc > 3 ? render(argv[2], argv[3]) : probe();
}
