"""Reads GLDF files (gldf.io): a zip with product.xml, which says which photometric file belongs to which variant of a luminaire."""
import os
import tempfile
import zipfile
import zlib
from dataclasses import replace

from ..fault import Fault, fault
from .eulumdat import read_eulumdat
from .ies import read_ies
from .intensities import checked_candela
from .tm33 import read_tm33
from .xml_file import MOST_BYTES, number_of, root_of, text_of

PRODUCT = "product.xml"
MOST_MEMBERS = 10000
READERS = {"ldc/eulumdat": read_eulumdat, "ldc/ies": read_ies, "ldc/iesxml": read_tm33}  # never another archive: it may hold itself
DIFFERENT = 0.01  # of the flux: photometric file and product differ by more


class Archive:
    """The members of a zip, none of which is ever written to a place that the archive names."""

    def __init__(self, file):
        self.file = file
        try:
            self.zip = zipfile.ZipFile(file)
        except OSError as error:
            raise fault(file, None, f"cannot be read: {error.strerror}") from None
        except (zipfile.BadZipFile, ValueError, NotImplementedError) as error:
            raise fault(file, None, f"is not a GLDF file: {error}") from None
        if len(self.zip.infolist()) > MOST_MEMBERS:
            raise fault(file, None, f"has more than {MOST_MEMBERS} files")
        self.names = {}
        for name in self.zip.namelist():
            if name.lower() in self.names:
                raise fault(file, None, f'has two files "{name[:80]}", of which either might be read; take one out')
            self.names[name.lower()] = name

    def has(self, name):
        return name.lower() in self.names

    def read(self, name):
        """The bytes of a member. What it says of its size is not believed."""
        try:
            member = self.zip.getinfo(self.names[name.lower()])
            if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):  # others may ask for gigabytes of memory
                raise NotImplementedError(f"method {member.compress_type} instead of deflate")
            if member.flag_bits & 1:
                raise NotImplementedError("it is encrypted; GLDF files are not")
            with self.zip.open(member) as stream:
                data = stream.read(MOST_BYTES + 1)
        except KeyError:
            raise fault(self.file, None, f'has no file "{name[:80]}"') from None
        except (zipfile.BadZipFile, zlib.error, EOFError, OSError, RuntimeError, NotImplementedError, ValueError) as error:
            raise fault(self.file, None, f'"{name[:80]}" cannot be unpacked: {error}') from None
        if len(data) > MOST_BYTES:
            raise fault(self.file, None, f'"{name[:80]}" is larger than {MOST_BYTES >> 20} MB')
        return data


class Product:
    """product.xml: its elements by their id."""

    def __init__(self, root, file):
        self.root, self.file = root, f"{file}: {PRODUCT}"

    def all(self, tag):
        return self.root.iter(tag)

    def named(self, tag, name, whose):
        """The element of a tag and an id. whose: the element that refers to it, or None."""
        found = [element for element in self.all(tag) if element.get("id") == name]
        if len(found) > 1:
            raise found[1].fault(self.file, f'there are two {tag} "{str(name)[:40]}"; take one out')
        if found:
            return found[0]
        known = ", ".join(sorted(str(e.get("id")) for e in self.all(tag))[:12]) or "none"
        wanted = f", which this {whose.tag} refers to" if whose is not None else ""
        raise fault(self.file, None if whose is None else whose.line, f'there is no {tag} "{str(name)[:40]}"{wanted}; there is {known}')

    def variant(self, name):
        variants = list(self.all("Variant"))
        if name is None and not variants:
            raise self.root.fault(self.file, "there is no Variant: is the product a luminaire?")
        return variants[0] if name is None else self.named("Variant", name, None)

    def emitter(self, variant, name):
        """The emitter of a variant: its only one, or that of this id."""
        ids = list(dict.fromkeys(e.get("emitterId") for e in variant.iter() if e.get("emitterId")))
        if name is None and len(ids) != 1:
            raise variant.fault(self.file, f'the variant "{variant.get("id")}" has {len(ids)} emitters' +
                        (f"; choose one by --emitter: {', '.join(map(str, ids[:12]))}" if ids else ""))
        if name is not None and name not in ids:
            raise variant.fault(self.file, f'the variant "{variant.get("id")}" has no emitter "{name[:40]}"; it has {", ".join(map(str, ids[:12]))}')
        return self.named("Emitter", ids[0] if name is None else name, variant)

    def light_of(self, emitter):
        """The light emitter of an emitter that is not for emergencies alone."""
        lights = [e for e in emitter if e.tag in ("FixedLightEmitter", "ChangeableLightEmitter")]
        usual = [e for e in lights if e.get("emergencyBehaviour") != "EmergencyOnly"]
        if not lights:
            raise emitter.fault(self.file, f'the emitter "{emitter.get("id")}" has neither a FixedLightEmitter nor a ChangeableLightEmitter; others are not read')
        if not usual:
            raise lights[0].fault(self.file, f'the emitter "{emitter.get("id")}" is for emergencies alone; choose another one, or take out emergencyBehaviour')
        if len(usual) > 1:
            raise usual[1].fault(self.file, f'the emitter "{emitter.get("id")}" has {len(usual)} light emitters; one is read: take the others out')
        return usual[0]

    def photometric_file(self, light):
        """The name of the photometric file of a light emitter in the archive, and what reads it."""
        photometry = self.referred(light, "PhotometryReference", "photometryId", "Photometry")
        entry = self.referred(photometry, "PhotometryFileReference", "fileId", "File")
        kind, name = entry.get("contentType"), (entry.text or "").strip()
        if kind not in READERS:
            raise entry.fault(self.file, f'the photometric file "{name[:80]}" is of the type {str(kind)[:40]}, not one of {", ".join(READERS)}')
        if entry.get("type") != "localFileName":
            raise entry.fault(self.file, f'the photometric file "{name[:80]}" is not in the archive; nothing is loaded from elsewhere')
        if not name or "/" in name or "\\" in name or name in (".", ".."):
            raise entry.fault(self.file, f'the name of the photometric file "{name[:80]}" leaves its folder; it is to be a name in ldc')
        return f"ldc/{name}", READERS[kind], entry

    def referred(self, element, tag, attribute, wanted):
        """The element that the reference inside of another leads to."""
        reference = element.find(tag)
        if reference is None:
            raise element.fault(self.file, f"this {element.tag} has no {tag}, and so no {wanted}")
        return self.named(wanted, reference.get(attribute), reference)


def read_gldf(file, variant=None, emitter=None):
    """The Photometry of a variant (the first) of a GLDF file, with the rated flux of its emitter. Raises Fault."""
    archive = Archive(file)
    product = Product(root_of(archive.read(PRODUCT), f"{file}: {PRODUCT}"), file)
    chosen = product.variant(variant)
    found = product.emitter(chosen, emitter)
    light = product.light_of(found)
    name, reader, entry = product.photometric_file(light)
    if not archive.has(name):
        raise entry.fault(product.file, f'the archive has no file "{name[:80]}"')
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, "photometry")
        with open(copy, "wb") as stream:
            stream.write(archive.read(name))
        try:
            read = reader(copy)
        except Fault as text:
            raise fault(file, None, str(text).replace(copy, name)) from None
    watts = watts_of(product, light) or read.watts
    title = text_of(chosen, "Name/Locale") or text_of(product.root, "ProductDefinitions/ProductMetaData/Name/Locale")
    maker = text_of(product.root, "Header/Manufacturer")
    flux = number_of(light, "RatedLuminousFlux", product.file, 0, 1e9, 0.0)
    measured, notes = read.lumens(), read.notes
    factor = flux / measured if flux > 0 and measured > 0 and not read.radiant else 1.0
    if abs(factor - 1) > DIFFERENT:
        notes += (f"the flux of the photometric file is {measured:.0f} lm; that of the emitter holds",)
    candela = checked_candela(read.candela * factor, product.file, light.line)
    return replace(read, file=file, name=f"{maker} {title}".strip() or read.name, candela=candela, watts=watts, notes=notes)


def watts_of(product, light):
    """The rated power of the light source of an emitter; 0 if it is not stated."""
    for reference, tag in (("fixedLightSourceId", "FixedLightSource"), ("changeableLightSourceId", "ChangeableLightSource")):
        for element in light.iter():
            if element.get(reference):
                return number_of(product.named(tag, element.get(reference), element), "RatedInputPower", product.file, 0, 1e6, 0.0)
    return 0.0
