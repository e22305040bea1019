"""GLDF, TM-33 and radiant files in rsphere.photometry: equal light, and faults in one line."""
import io
import os
import unittest
import unittest.mock
import zipfile

import numpy as np

import rsphere
from rsphere.fault import Fault
from rsphere.photometry import UgrTable, read_luminaire
from rsphere.photometry.radiant import unit_in
from run_here import InAFolder, built, run_here
from test_luminaires import BOX, PANEL, eulumdat

PRODUCT = """<?xml version="1.0" encoding="UTF-8"?>
<Root>
<Header><Manufacturer>maker</Manufacturer></Header>
<GeneralDefinitions>
<Files>
<File id="ldt" contentType="ldc/eulumdat" type="localFileName">strip.ldt</File>
<File id="ies" contentType="ldc/ies" type="localFileName">box.ies</File>
</Files>
<Photometries>
<Photometry id="p1"><PhotometryFileReference fileId="ldt"/></Photometry>
<Photometry id="p2"><PhotometryFileReference fileId="ies"/></Photometry>
</Photometries>
<LightSources><FixedLightSource id="s1"><RatedInputPower>47.5</RatedInputPower></FixedLightSource></LightSources>
<Emitters>
<Emitter id="e1"><FixedLightEmitter><PhotometryReference photometryId="p1"/><LightSourceReference fixedLightSourceId="s1"/>
<RatedLuminousFlux>500</RatedLuminousFlux></FixedLightEmitter></Emitter>
<Emitter id="e2"><FixedLightEmitter><PhotometryReference photometryId="p2"/></FixedLightEmitter></Emitter>
</Emitters>
</GeneralDefinitions>
<ProductDefinitions><ProductMetaData><Name><Locale language="en">strip</Locale></Name></ProductMetaData>
<Variants>
<Variant id="v1"><Geometry><EmitterReference emitterId="e1"/></Geometry></Variant>
<Variant id="v2"><Name><Locale language="en">two</Locale></Name><Geometry><ModelGeometryReference geometryId="g">
<EmitterReference emitterId="e1"/><EmitterReference emitterId="e2"/></ModelGeometryReference></Geometry></Variant>
</Variants></ProductDefinitions>
</Root>
"""

TM33 = """<?xml version="1.0"?>
<IESTM33-22 xmlns="http://www.ies.org/tm-33">
<Version>1.1</Version>
<Header><Manufacturer>maker</Manufacturer><Description>lamp</Description></Header>
<Luminaire><Dimensions><Length>1.2</Length><Width>.3</Width><Height>.1</Height></Dimensions></Luminaire>
<Emitter><Quantity>1</Quantity><InputWattage>36</InputWattage>
<LuminousData><LuminousIntensity><Multiplier>2</Multiplier>
DATA
</LuminousIntensity></LuminousData></Emitter>
</IESTM33-22>
"""


def intensities(values):
    """values: by h, those of v = 0, 45, 90."""
    return "\n".join(f'<IntData h="{h}" v="{v}">{value}</IntData>' for h, row in values.items() for v, value in zip((0, 45, 90), row))


DATA = intensities({0: (180, 100, 0), 90: (180, 120, 20)})


class Formats(InAFolder):
    def gldf(self, product=PRODUCT, members=None, name="lamp.gldf"):
        made = io.BytesIO()
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
            for member, data in {"product.xml": product, "ldc/strip.ldt": eulumdat(), "ldc/box.ies": BOX, **(members or {})}.items():
                if data is not None:
                    archive.writestr(member, data)
        return self.file(made.getvalue(), name)

    def refused(self, path, words, **options):
        with self.assertRaises(Fault) as caught:
            read_luminaire(path, **options)
        self.assertTrue(str(caught.exception).startswith(path + ":"), str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        self.assertRegex(str(caught.exception), words)

    def test_gldf(self):
        """The distribution of the photometric file, with the flux and the power of the product."""
        found, alone = read_luminaire(self.gldf()), read_luminaire(self.file(eulumdat(), "strip.ldt"))
        self.assertAlmostEqual(found.lumens(), 500, places=6)
        np.testing.assert_allclose(found.candela, alone.candela * 500 / alone.lumens())
        self.assertEqual((found.watts, found.name, found.size), (47.5, "maker strip", alone.size))
        self.assertRegex(found.notes[0], "photometric file is [0-9]+ lm")
        other = read_luminaire(self.gldf(name="plain.zip"), variant="v2", emitter="e2")
        np.testing.assert_array_equal(other.candela, read_luminaire(self.file(BOX, "box.ies")).candela)
        self.assertEqual((other.watts, other.name, other.notes), (70, "maker two", ()))

    def test_gldf_as_scene(self):
        run = run_here([built("rsphere-luminaire"), "-o", self.folder.name, self.gldf()])
        self.assertRegex(run.stdout, r"\A# maker_strip from lamp\.gldf: 500 lm, 47\.5 W\n# the flux of the photometric file is")
        self.assertEqual(run.stderr, "")

    def test_flux_of_scenes(self):
        """The light that leaves the scene of a GLDF and of a TM-33 file, over all directions, is that of the file within .1%."""
        cosines, weights = np.polynomial.legendre.leggauss(8)
        gammas = np.radians(np.concatenate([22.5 * (1 + cosines) + begin for begin in (0, 45, 90, 135)]))  # the files have steps of 45 degrees
        angles = 2 * np.pi * (np.arange(48) + 0.5) / 48
        down = np.stack([np.outer(np.sin(gammas), f(angles)) for f in (np.cos, np.sin)] + [np.outer(-np.cos(gammas), angles > -1)], axis=-1)
        steradians = np.tile(weights, 4) * np.radians(22.5) * np.sin(gammas) * 2 * np.pi / 48
        for file, lumens in ((self.gldf(), 500), (self.file(TM33.replace("DATA", DATA), "lamp.xml"), None)):
            scene = self.file(run_here([built("rsphere-luminaire"), "-o", self.folder.name, file]).stdout, "lamp.rad")
            with unittest.mock.patch.dict(os.environ, RAYPATH=self.folder.name):
                found = rsphere.Scene([scene]).trace(np.concatenate([100 * down, -down], axis=-1).reshape(-1, 6), irradiance_at_origin=True,
                                                     ambient_bounces=0, dt=0, dj=0, ds=0.02).value
            candela = rsphere.photometric(found).reshape(down.shape[:2]) * 100**2
            self.assertAlmostEqual(candela.sum(axis=1) @ steradians / (lumens or read_luminaire(file).lumens()), 1, delta=1e-3)

    def test_hostile_gldf(self):
        bomb = b"<Root>" + b" " * (40 << 20) + b"</Root>"
        laughs = '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "' + "c" * 99 + '">]><Root>&b;</Root>'
        change = lambda before, after: PRODUCT.replace(before, after, 1)  # noqa: E731
        for product, members, words in (
            (bomb, {}, "product.xml.* is larger than 16 MB"),
            (laughs, {}, r"product\.xml:1: a document type"),
            (laughs.encode("utf-16"), {}, "a document type"),
            (None, {}, 'has no file "product.xml"'),
            ("<Root>", {}, "product.xml:1: is not well-formed XML"),
            ("<Root/>", {}, "no Variant"),
            (b"\xff\xfe\x00", {}, "not (well-formed )?XML"),
            (change(">strip.ldt<", ">../../etc/passwd<"), {}, "leaves its folder"),
            (change(">strip.ldt<", ">/etc/passwd<"), {}, "leaves its folder"),
            (change(">strip.ldt<", r">..\x.ldt<"), {}, "leaves its folder"),
            (change(">strip.ldt<", "><"), {}, "leaves its folder"),
            (change('type="localFileName">strip', 'type="url">http://strip'), {}, "nothing is loaded from elsewhere"),
            (change("ldc/eulumdat", "ldc/gldf"), {}, "is of the type ldc/gldf"),
            (change('fileId="ldt"', 'fileId="p1"'), {}, 'product.xml:10: there is no File "p1", .*; there is ies, ldt'),
            (change('photometryId="p1"', 'photometryId="e1"'), {}, r'product\.xml:\d+: there is no Photometry "e1"'),
            (change('emitterId="e1"', 'emitterId="v1"'), {}, r'product\.xml:\d+: there is no Emitter "v1"'),
            (change('<EmitterReference emitterId="e1"/>', ""), {}, r'product\.xml:\d+: the variant "v1" has 0 emitters'),
            (change('<PhotometryFileReference fileId="ldt"/>', ""), {}, r"product\.xml:10: this Photometry has no PhotometryFileReference"),
            (change("<RatedLuminousFlux>500", "<RatedLuminousFlux>nan"), {}, r"product\.xml:\d+: RatedLuminousFlux must be a number"),
            (change("47.5", "-1"), {}, r"product\.xml:\d+: RatedInputPower must be from"),
            (change("FixedLightEmitter>", "MultiLight>").replace("</FixedLightEmitter>", "</MultiLight>", 1), {}, "neither a FixedLightEmitter"),
            (change(">500</RatedLuminousFlux>", ">500</RatedLuminousFlux><RatedLuminousFlux>700</RatedLuminousFlux>"), {}, "has two RatedLuminousFlux; take one out"),
            (change('File id="ies"', 'File id="ldt"'), {}, 'product.xml:7: there are two File "ldt"; take one out'),
            (PRODUCT, {"ldc/strip.ldt": None}, 'product.xml:6: the archive has no file "ldc/strip.ldt"'),
            (PRODUCT, {"ldc/strip.ldt": "x\n"}, r"ldc/strip\.ldt:"),
            (PRODUCT, {"ldc/strip.ldt": b" " * (40 << 20)}, "strip.ldt.* is larger than 16 MB"),
            (PRODUCT, {f"doc/{i}": "" for i in range(10001)}, "more than 10000 files"),
            ("<Root>" + "<a/>" * 300_000 + "</Root>", {}, "more than 300000 elements"),
            ("<a>" * 1000 + "</a>" * 1000, {}, "more than 100 in each other"),
            (b"\xfe\xff\0<\0!", {}, "product.xml.* is not"),
            ('<?xml version="1.0" encoding="utf-7"?><Root/>', {}, "product.xml.* is not"),
            (change('id="v1"', ''), {"ldc/strip.ldt": None}, 'has no file "ldc/strip.ldt"'),
            (change('<File id="ldt"', '<File id="p"'), {}, 'no File "ldt"'),
            (change(">strip.ldt<", ">strip.ldt&#0;<"), {}, "product.xml:6: is not well-formed XML"),
            (change(">strip.ldt<", ">strip&#10;.ldt<"), {}, 'has no file "ldc/strip\\?.ldt"'),
            (change(">strip.ldt<", ">C:\\strip.ldt<"), {}, "leaves its folder"),
            (change(">strip.ldt<", ">..<"), {}, "leaves its folder"),
            (change(">strip.ldt<", ">product.xml<"), {}, 'has no file "ldc/product.xml"'),
            (change("<RatedLuminousFlux>500", "<RatedLuminousFlux>1e10"), {}, "RatedLuminousFlux must be from"),
            (change('fixedLightSourceId="s1"', 'fixedLightSourceId="s2"'), {}, 'no FixedLightSource "s2"'),
            (PRODUCT, {"Product.XML": PRODUCT}, 'has two files "Product.XML", of which either might be read; take one out'),
            (PRODUCT, {"LDC/strip.ldt": eulumdat()}, 'has two files "LDC/strip.ldt"'),
            (change("<RatedLuminousFlux>500", "<RatedLuminousFlux>1e-9"), {}, r"product\.xml:15: with all factors, the largest intensity is 3\.59e-10 cd; it must be from"),
            (change("<FixedLightEmitter>", '<FixedLightEmitter emergencyBehaviour="EmergencyOnly">'), {}, r'product\.xml:15: the emitter "e1" is for emergencies alone; choose another'),
            (change("<FixedLightEmitter>", '<FixedLightEmitter><PhotometryReference photometryId="p2"/></FixedLightEmitter><FixedLightEmitter>'), {},
             r'product\.xml:15: the emitter "e1" has 2 light emitters; one is read: take the others out'),
            (change('<PhotometryFileReference fileId="ldt"/>', '<PhotometryReference photometryId="p1"/>'), {}, "product.xml:10: this Photometry has no PhotometryFileReference"),
            (change('photometryId="p1"/>', 'photometryId="p2"/>'), {"ldc/box.ies": BOX.replace("TILT=NONE", "TILT=/etc/passwd")}, "box.ies:2: TILT=/etc/passwd: .*same folder"),
            (change('photometryId="p1"/>', 'photometryId="p2"/>'), {"ldc/box.ies": BOX.replace("TILT=NONE", "TILT=strip.ldt")}, "box.ies:2: TILT=strip.ldt: .*cannot be read"),
        ):
            with self.subTest(words=words):
                self.refused(self.gldf(product, members), words)
        for method in (zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA):  # whose dictionaries may be of 4 GB
            path = os.path.join(self.folder.name, "other.gldf")
            with zipfile.ZipFile(path, "w", method) as archive:
                archive.writestr("product.xml", PRODUCT)
            self.refused(path, "instead of deflate")
        with open(self.gldf(), "rb") as stream:
            inner = stream.read()
        self.refused(self.gldf(PRODUCT, {"ldc/strip.ldt": inner}), "not a text file")  # an archive in an archive
        self.refused(self.gldf(), 'no Variant "v3"; there is v1, v2', variant="v3")
        self.refused(self.gldf(), "v2.* has 2 emitters; choose one by --emitter: e1, e2", variant="v2")
        self.refused(self.gldf(), 'no emitter "e2"; it has e1', emitter="e2")
        self.refused(PANEL, "is not a GLDF file, which alone has a variant", variant="v1")

    def test_tilt_files_of_other_folders(self):
        """A fault in them was printed with their first word, whatever file it was."""
        for name in ("/etc/passwd", "../../etc/passwd", "..", "C:\\tilt.txt", "a/../lamp.ies"):
            self.refused(self.file(BOX.replace("TILT=NONE", f"TILT={name}")), "lamp.ies:2: .*in the same folder")
        self.refused(self.file(BOX.replace("TILT=NONE", "TILT=lamp.ies")), "lamp.ies:1: the lamp's position")  # of itself
        os.symlink("/etc/passwd", os.path.join(self.folder.name, "link.txt"))
        self.refused(self.file(BOX.replace("TILT=NONE", "TILT=link.txt")), "lamp.ies:2: TILT=link.txt: the file of tilt factors is a link to another folder")

    def test_pipes(self):
        """They were waited for without end."""
        os.mkfifo(os.path.join(self.folder.name, "pipe.ies"))
        self.refused(os.path.join(self.folder.name, "pipe.ies"), "pipe.ies: is a pipe or a device, and a luminaire is read twice; write it to a file")
        self.refused(self.file(BOX.replace("TILT=NONE", "TILT=pipe.ies")), "lamp.ies:2: TILT=pipe.ies: is a pipe or a device, not a file of tilt factors")
        self.refused("/dev/zero", "is a pipe or a device")

    def test_emergency_beside_the_usual_light(self):
        """Its photometry was read if it came first."""
        other = '<FixedLightEmitter emergencyBehaviour="EmergencyOnly"><PhotometryReference photometryId="p2"/></FixedLightEmitter>'
        found = read_luminaire(self.gldf(PRODUCT.replace('<Emitter id="e1">', '<Emitter id="e1">' + other)))
        self.assertAlmostEqual(found.lumens(), 500, delta=1)

    def test_names(self):
        """Control characters of a name went to the terminal and into drawings, and names of megabytes into scenes."""
        for file in (self.file(BOX.replace("TILT=NONE", "[MANUFAC] a\x1b[31mb" + "m" * 1_000_000 + "\nTILT=NONE")),
                     self.gldf(PRODUCT.replace(">maker<", ">a\u202e[31mb" + "m" * 1_000_000 + "<"))):
            name = read_luminaire(file).name
            self.assertEqual((name[:8], len(name)), ("a?[31mbm", 100))

    def test_encrypted(self):
        with open(self.gldf(), "rb") as stream:
            data = bytearray(stream.read())
        data[data.index(b"PK\1\2") + 8] |= 1
        self.refused(self.file(bytes(data), "lamp.gldf"), '"product.xml" cannot be unpacked: it is encrypted; GLDF files are not')

    def test_each_part_of_an_archive_replaced(self):
        """Whatever bytes are wrong: a fault of one line, or a luminaire."""
        with open(self.gldf(), "rb") as stream:
            good = stream.read()
        random = np.random.default_rng(7)
        refused = 0
        for i in range(150):
            data = bytearray(good)
            at = int(random.integers(4, len(data)))
            data[at : at + 4] = random.bytes(4)
            try:
                read_luminaire(self.file(bytes(data[: None if i % 3 else at + 8]), "lamp.gldf"))
            except Fault as text:
                refused += 1
                self.assertNotIn("\n", str(text))
        self.assertGreater(refused, 50)

    def test_tm33(self):
        found = read_luminaire(self.file(TM33.replace("DATA", DATA), "lamp.xml"))
        self.assertEqual((found.name, found.watts, found.shape, found.axis), ("maker lamp", 36, "box", "y"))
        np.testing.assert_allclose(found.size[:2], (0.3, 1.2))
        s = np.sqrt(0.5)
        np.testing.assert_allclose(found.intensity(np.array([[0, 0, -1], [s, 0, -s], [0, s, -s], [0, -1, 0]])), (360, 200, 240, 40))
        again = read_luminaire(self.file(eulumdat(), "same.ldt"))
        np.testing.assert_allclose(found.candela, again.candela)  # the same, as EULUMDAT
        radiant = TM33.replace("Luminous", "Radiant").replace("DATA", DATA)
        self.assertTrue(read_luminaire(self.file(radiant, "uv.xml")).radiant)

    def test_hostile_tm33(self):
        text = TM33.replace("DATA", DATA)
        for changed, words in (
            (text.replace("IESTM33-22", "Luminaires"), 'of a "Luminaires"'),
            (text.replace("</Emitter>", "</Emitter><Emitter/>"), "there are 2 emitters"),
            (text.replace("LuminousIntensity", "PhotonIntensity"), "neither LuminousData/LuminousIntensity nor"),
            (text.replace("<Multiplier>2", "<AbsolutePhotometry>false</AbsolutePhotometry><Multiplier>2"), "are relative"),
            (text.replace("<Quantity>1", "<Quantity>5"), "the luminaire has several emitters of this kind"),
            (text.replace("<Multiplier>2", "<Multiplier>2</Multiplier><Multiplier>3"), "LuminousIntensity has two Multiplier"),
            (text.replace("<Multiplier>2", "<Multiplier>nan"), "Multiplier must be a number"),
            (text.replace('h="0" v="45"', 'h="0" v="0"'), "two intensities for h=0, v=0"),
            (text.replace('h="0" v="45"', 'h="0" v="46"'), "6 intensities for 2 x 4 angles; the first without one is h=0, v=45"),
            (text.replace('h="0" v="45"', 'h="0" v="200"'), "angle v of IntData must be from"),
            (text.replace('h="0" v="45"', 'v="45"'), "angle h of IntData must be a number"),
            (text.replace(">100<", ">-100<"), "intensity must be from 0"),
            (text.replace(">100<", ">1e300<"), "intensity must be from 0"),
            (text.replace('h="90"', 'h="70"'), "horizontal angles from 0 to 70 are none of"),
            (TM33.replace("DATA", intensities({0: (0, 0, 0)})), "all intensities are 0"),
            (text.replace("</LuminousIntensity>", "</LuminousIntensity><LuminousIntensity/>"), "Emitter has two LuminousData/LuminousIntensity; take one out"),
            (text.replace("</Dimensions>", "</Dimensions><Dimensions/>"), "IESTM33-22 has two Luminaire/Dimensions; take one out"),
            (TM33.replace("DATA", ""), "0 horizontal and 0 vertical angles"),
            (text.replace("<Length>1.2", "<Length>x"), "Length must be a number"),
            (text.replace("<Width>.3</Width>", ""), "Dimensions has no Width"),
            (text[:-30], "is not well-formed XML"),
            (text.replace("<IESTM33-22", "<!DOCTYPE a><IESTM33-22", 1), "a document type"),
        ):
            with self.subTest(words=words):
                self.assertNotEqual(changed, text)
                self.refused(self.file(changed, "lamp.xml"), r"lamp\.xml:\d+: .*" + words)

    def test_radiant(self):
        """Milliwatts were taken for lumens: a thousandth of 179 times the irradiance of the same numbers as candela, in W/m2."""
        lamp = self.file(BOX.replace("TILT=NONE", "[OTHER] 222 nm, intensities in mW/sr\nTILT=NONE"), "uv.ies")
        found, light = read_luminaire(lamp), read_luminaire(self.file(BOX, "box.ies"))
        self.assertTrue(found.radiant)
        np.testing.assert_allclose(found.candela, light.candela / 1000)
        run = run_here([built("rsphere-luminaire"), "-o", self.folder.name, lamp])
        self.assertRegex(run.stdout, r"\A# .*: [0-9.]+ W radiant \(rsphere -pA has W/m2\), 70 W\n")
        np.testing.assert_allclose(self.irradiance(run) * 1000, self.irradiance(run_here(
            [built("rsphere-luminaire"), "-o", self.folder.name, "--intensity", "cd", lamp])) * rsphere.LUMENS_PER_WATT, rtol=1e-6)
        with self.assertRaisesRegex(Fault, "is radiant"):
            UgrTable(found)

    def irradiance(self, run):
        """W/m2, 20 m below a lamp that was written."""
        scene = self.file(run.stdout, "lamp.rad")
        before, os.environ["RAYPATH"] = os.environ.get("RAYPATH", "."), self.folder.name
        try:
            return rsphere.Scene([scene]).trace([[0, 0, -20, 0, 0, 1]], irradiance_at_origin=True, ab=0, dt=0, dj=0, lr=0).value[0]
        finally:
            os.environ["RAYPATH"] = before

    def test_units_of_radiant_files(self):
        for text, unit in (("in W/sr", (True, 1)), ("mW / sr", (True, 1e-3)), ("\xb5W/sr", (True, 1e-6)), ("uW per steradian", (True, 1e-6)),
                           ("watts/steradian", (True, 1)), ("36W SR panel", (False, 1)), ("Radiant Lighting Ltd., 18 W", (False, 1)),
                           ("UV stabilised diffuser", (False, 1)), ("UV-C lamp", None), ("254 nm", None), ("radiant intensity", None)):
            self.assertEqual(unit_in(text), unit, text)
        lamp = self.file(BOX.replace("TILT=NONE", "[LAMP] germicidal\nTILT=NONE"), "uv.ies")
        self.refused(lamp, "not in which unit; say so by --intensity")
        self.assertFalse(read_luminaire(lamp, intensity="cd").radiant)
        self.assertAlmostEqual(read_luminaire(lamp, intensity="mW/sr").candela.max(), read_luminaire(lamp, intensity="cd").candela.max() / 1000)
        run = run_here([built("rsphere-luminaire"), "--intensity", "lm", lamp])
        self.assertRegex(run.stderr, r"\Arsphere-luminaire: fatal - [^\n]*invalid choice: 'lm'[^\n]*\n\Z")


if __name__ == "__main__":
    unittest.main()
