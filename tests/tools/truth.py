"""How many of a drawing's parts were found: the report against the truth that stands beside each example."""


def inside(ring, point):
    """True when the point lies in the ring (even-odd rule)."""
    x, y = point
    odd = False
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            odd = not odd
    return odd


def area(ring):
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]))) / 2


def roles_for(part):
    """The roles under which an expected part counts as found: an eye may be a part of its own in front."""
    if part.get("kind") == "island":
        return {"island", "foreground"}
    return {"body"} if part.get("kind") == "body" else {part["role"]}


def differences(truth, report):
    """What the report has wrong, as sentences: parts that are missing or too many, pairs that are not paired."""
    wrong, found = [], {}
    for part in truth["parts"]:
        holding = [(area(ring), other) for other in report["parts"] for ring in other["outlines"]
                   if inside(ring, part["point"])]
        taken = {other["id"] for other in found.values()}
        for _, other in sorted(holding, key=lambda entry: entry[0]):
            if other["role"] in roles_for(part) and other["id"] not in taken:
                found[part["name"]] = other
                break
        if part["name"] not in found and not part.get("optional"):
            wrong.append(f"no {'/'.join(sorted(roles_for(part)))} part at {part['point']} "
                         f"for {part['name']}")
    optional = {part["name"] for part in truth["parts"] if part.get("optional")}
    for pair in truth.get("symmetric_pairs", []):
        near, far = (found.get(name) for name in pair)
        paired = near and far and (near["pair"] == far["id"] or far["pair"] == near["id"])
        if not paired and not optional & set(pair):
            wrong.append(f"{pair[0]} and {pair[1]} are no pair")
    eyes = {found[part["name"]]["id"] for part in truth["parts"]
            if part.get("kind") == "island" and part["name"] in found}
    expected = sum(part.get("kind") != "island" for part in truth["parts"])
    reported = sum(part["role"] != "island" and part["id"] not in eyes for part in report["parts"])
    if reported > expected:
        wrong.append(f"{reported - expected} parts too many")
    return wrong
