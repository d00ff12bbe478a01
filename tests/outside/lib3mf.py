"""lib3mf, the 3MF Consortium's own reader, by its C interface (version 1.8)."""
import ctypes
import ctypes.util


class Lib3mfError(Exception):
    pass


def available():
    return ctypes.util.find_library("3MF") is not None


class Package:
    """What lib3mf finds in a 3MF file."""

    def __init__(self, path):
        self._library = ctypes.CDLL(ctypes.util.find_library("3MF"))
        model, reader = ctypes.c_void_p(), ctypes.c_void_p()
        self._call("createmodel", ctypes.byref(model))
        self._call("model_queryreader", model, b"3mf", ctypes.byref(reader))
        self._call("reader_readfromfileutf8", reader, str(path).encode())
        self.warnings = self._number("reader_getwarningcount", reader)
        self.unit = self._number("model_getunit", model)  # 2 is the millimetre
        self.objects = [
            {"vertices": self._number("meshobject_getvertexcount", mesh),
             "triangles": self._number("meshobject_gettrianglecount", mesh),
             "closed": bool(self._number("meshobject_ismanifoldandoriented", mesh)),
             "name": self._text("object_getnameutf8", mesh)}
            for mesh in self._resources("model_getmeshobjects", model)]
        self.materials = []
        for group in self._resources("model_getbasematerials", model):
            for i in range(self._number("basematerial_getcount", group)):
                color = [ctypes.c_ubyte() for _ in range(4)]
                self._call("basematerial_getdisplaycolor", group, i, *map(ctypes.byref, color))
                name = self._text("basematerial_getnameutf8", group, i)
                self.materials.append((name, tuple(c.value for c in color[:3])))
        thumbnail = ctypes.c_void_p()
        self._call("model_getpackagethumbnailattachment", model, False, ctypes.byref(thumbnail))
        size = ctypes.c_uint64()
        self._call("attachment_getstreamsize", thumbnail, ctypes.byref(size))
        self.thumbnail_bytes = size.value

    def _call(self, name, *arguments):
        code = getattr(self._library, "lib3mf_" + name)(*arguments)
        if code != 0:
            raise Lib3mfError(f"{name}: {code & 0xffffffff:#x}")

    def _number(self, name, *arguments):
        value = ctypes.c_uint32()
        self._call(name, *arguments, ctypes.byref(value))
        return value.value

    def _text(self, name, *arguments):
        buffer, needed = ctypes.create_string_buffer(1000), ctypes.c_uint32()
        self._call(name, *arguments, buffer, len(buffer), ctypes.byref(needed))
        return buffer.value.decode()

    def _resources(self, name, model):
        iterator = ctypes.c_void_p()
        self._call(name, model, ctypes.byref(iterator))
        while self._number("resourceiterator_movenext", iterator):
            resource = ctypes.c_void_p()
            self._call("resourceiterator_getcurrent", iterator, ctypes.byref(resource))
            yield resource
