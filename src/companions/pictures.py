"""Pictures: PNG and RADIANCE's by themselves, others by the shared object with which rsphere writes them."""
import ctypes
import math
import os
import struct
import zlib

from .program import Fault, program_beside

OF_RADIANCE, LINEAR = (".hdr", ".pic"), (".exr", ".tif", ".tiff", ".pfm")  # the suffixes of formats that store radiance
TAKE = ctypes.CFUNCTYPE(None, ctypes.POINTER(ctypes.c_char), ctypes.c_size_t, ctypes.c_char_p)


def stores_radiance(name):
    """Whether the format of this name stores radiance; others store screen colors."""
    return suffix_of(name) in OF_RADIANCE + LINEAR


def suffix_of(name):
    return os.path.splitext(name)[1].lower()


def png(width, height, pixels):
    """pixels: red, green and blue of each, screen colors from 0 to 1, beginning with the highest row."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    values = bytes(int(255 * min(max(x, 0.0), 1.0) + .5) for x in pixels)
    rows = b"".join(b"\0" + values[at:at + 3 * width] for at in range(0, 3 * width * height, 3 * width))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


def rgbe(width, height, pixels):
    """A picture of RADIANCE, without compression."""
    def pixel(at):
        color = [max(x, 0.0) for x in pixels[at:at + 3]]
        most = max(color)
        if most <= 1e-32:
            return b"\0\0\0\0"
        exponent = math.frexp(most)[1]
        return bytes(int(math.ldexp(x, 8 - exponent)) for x in color) + bytes((exponent + 128,))
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    return head.encode() + b"".join(map(pixel, range(0, 3 * width * height, 3)))


def encoded(name, width, height, pixels):
    """The bytes of a picture in the format of its name, by OpenImageIO."""
    codec = os.path.join(os.path.dirname(program_beside("rsphere")), "../lib/rsphere/openimageio.so")
    try:
        encode = ctypes.CDLL(os.path.realpath(codec)).rsphereEncode
    except OSError:
        raise Fault(f'cannot write picture "{name}": only .hdr and .png are written without OpenImageIO, which is missing; '
                    "on Debian: apt install rsphere-pictures", "system") from None
    taken = []
    take = TAKE(lambda data, size, fault: taken.append((ctypes.string_at(data, size), fault)))
    encode(os.fsencode(name), width, height, stores_radiance(name), (ctypes.c_float * len(pixels))(*pixels), take)
    data, fault = taken[0]
    if fault:
        raise Fault(f'cannot write picture "{name}": {os.fsdecode(fault)}', "system")
    return data


def write_picture(name, width, height, pixels):
    """Writes pixels in the format of the name. An incomplete picture is never visible. Raises Fault."""
    formats = {".png": png, **dict.fromkeys(OF_RADIANCE, rgbe)}
    data = formats[suffix_of(name)](width, height, pixels) if suffix_of(name) in formats else encoded(name, width, height, pixels)
    target = os.path.realpath(name)
    part = f"{target}.{os.getpid()}"
    whole = not os.path.exists(target) or os.path.isfile(target)  # what is no file is written directly
    try:
        with open(part if whole else target, "wb") as stream:
            stream.write(data)
        if whole:
            os.replace(part, target)
    except OSError as error:
        if os.path.exists(part):
            os.remove(part)
        raise Fault(f'cannot write picture "{name}": {error.strerror}', "system") from None
