#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# Writes docs/api.md from docs/openapi.yaml: docs/make_api.py [--check]. With --check it only tells whether they agree.
import pathlib
import sys

import yaml

import page

HERE = pathlib.Path(__file__).parent
HEAD = """# The control API

<!-- docs/make_api.py writes this page from openapi.yaml: change that, and run it again. -->

{description}

The usual socket is `control.sock` in the [run directory](running.md#files):

<!-- beside: scipd --config scenes/beside_a_scanner.yaml -->
```sh
curl --unix-socket "$XDG_RUNTIME_DIR/scipd/control.sock" http://scipd/status
curl --unix-socket "$XDG_RUNTIME_DIR/scipd/control.sock" http://scipd/sensors/robot/sonar/reading
curl --unix-socket "$XDG_RUNTIME_DIR/scipd/control.sock" -X PUT -d '{{"xyz":[1,0.5,0]}}' http://scipd/robots/robot/pose
```

[scipctl](tools.md#scipctl) does the same in fewer words. [openapi.yaml](openapi.yaml) has all of this page
for programs.

## Requests

| request | what it does |
|---|---|
"""


BOUNDS = {"minimum": "at least", "maximum": "at most", "exclusiveMinimum": "above", "default": "default"}


class Document:
    def __init__(self, root):
        self.root = root

    def follow(self, node):
        while "$ref" in node:
            target = self.root
            for key in node["$ref"].removeprefix("#/").split("/"):
                target = target[key]
            node = {**target, **{key: value for key, value in node.items() if key != "$ref"}}
        return node

    def operations(self):
        for path, item in self.root["paths"].items():
            for method, operation in item.items():
                if method != "parameters":
                    yield path, method.upper(), operation, item.get("parameters", []) + operation.get("parameters", [])


def anchor(title):
    return "".join(c for c in title.lower().replace(" ", "-") if c.isalnum() or c in "-_")


def type_of(schema, linked=True):
    """What a value is, in words."""
    if "$ref" in schema:
        name = schema["$ref"].split("/")
        name = name[-1] if name[-2] == "schemas" else name[-3] + "." + name[-1]
        return f"[{name}](#{anchor(name)})" if linked and "." not in name else name
    if "oneOf" in schema and all("required" not in one for one in schema["oneOf"]):
        return " or ".join(type_of(one) for one in schema["oneOf"])
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    if "const" in schema:
        return f"`{schema['const']}`"
    kinds = schema.get("type", "any")
    kinds = [kinds] if isinstance(kinds, str) else kinds
    if "array" in kinds:
        least, most = schema.get("minItems"), schema.get("maxItems")
        return (f"{least} of " if least == most and least else "list of ") + type_of(schema["items"])
    return " or ".join(kinds) + "".join(f", {word} {str(schema[key]).lower()}" for key, word in BOUNDS.items()
                                       if key in schema)


def text_of(schema):
    return " ".join(schema.get("description", "").split())


def order_of(document, schema):
    """Of the numbers of a vector."""
    return text_of(document.follow(schema)) if schema.get("$ref", "").endswith(("/Vector", "/Quaternion")) else ""


def fields_of(document, schema, prefix=""):
    """(name, type, needed, description) of an object, with the objects in it."""
    needed = schema.get("required", [])
    for name, field in schema["properties"].items():
        inner = field.get("items", field)
        yield prefix + name, type_of(field), name in needed, text_of(field) or order_of(document, field)
        if "properties" in inner:
            yield from fields_of(document, inner, prefix + name + ("[]." if inner is not field else "."))


def request_part(document, path, method, operation, parameters):
    text = f"## {method} {path}\n\n{operation['summary']}.\n\n"
    if operation.get("description"):
        text += page.wrapped(text_of(operation)) + "\n\n"
    queries = [document.follow(parameter) for parameter in parameters if document.follow(parameter)["in"] == "query"]
    for query in queries:
        text += page.wrapped(f"- `?{query['name']}=`: {text_of(query)}.", "  ") + "\n"
    if "requestBody" in operation:
        text += f"- body: {type_of(operation['requestBody']['content']['application/json']['schema'])}\n"
    for status, response in operation["responses"].items():
        response = document.follow(response)
        content = [type_of(media["schema"]) for media in response.get("content", {}).values()]
        text += f"- {status}: {response['description'][0].lower()}{response['description'][1:]}" + (
            f": {content[0]}" if content else "") + "\n"
    return text + "\n"


def schema_part(document, name, schema):
    text = f"## {name}\n\n"
    if text_of(schema):
        text += page.wrapped(text_of(schema).rstrip(".") + ".") + "\n\n"
    if "properties" not in schema:
        return text + type_of(schema) + "\n\n"
    text += "| field | type | required | what it is |\n|---|---|---|---|\n"
    for field, kind, needed, description in fields_of(document, schema):
        text += f"| `{field}` | {kind} | {'yes' if needed else 'no'} | {description} |\n"
    return text + "\n"


def api_page():
    document = Document(yaml.safe_load((HERE / "openapi.yaml").read_text()))
    operations = list(document.operations())
    text = HEAD.format(description=page.wrapped(text_of(document.root["info"])))
    for path, method, operation, _ in operations:
        text += f"| [{method} {path}](#{anchor(method + ' ' + path)}) | {operation['summary']} |\n"
    text += "\n" + "".join(request_part(document, *operation) for operation in operations)
    schemas = document.root["components"]["schemas"].items()
    return text + "".join(schema_part(document, name, schema) for name, schema in schemas).rstrip() + "\n"


page.write_or_check(HERE / "api.md", api_page(), "docs/make_api.py", check="--check" in sys.argv)
