# SPDX-License-Identifier: Apache-2.0
# Copyright The scipd authors
#
# A shared world whose broker asks who one is: TLS, users, and certificates of clients. fleet_tls_test.py SCIPD SCIPCTL
import subprocess
import sys

from fault_lab import PATIENCE_S, wait_for
from fleet_lab import BOX, CRATE, Broker, FakeBroker, FleetLab, free_port

USER = "guest"
PASSWORD = "correct horse"


def openssl(folder, *words):
    subprocess.run(["openssl", *words], cwd=folder, check=True, capture_output=True, timeout=PATIENCE_S)


def make_certificates(folder):
    """An authority, and what it says of the broker and of a daemon; and another authority, which knows nobody."""
    for authority in ("ca", "stranger"):
        openssl(folder, "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", f"/CN={authority}",
                "-keyout", f"{authority}.key", "-out", f"{authority}.pem")
    (folder / "names").write_text("subjectAltName=IP:127.0.0.1,DNS:localhost\n")
    for who in ("broker", "daemon"):
        openssl(folder, "req", "-newkey", "rsa:2048", "-nodes", "-subj", f"/CN={who}", "-keyout", f"{who}.key", "-out",
                f"{who}.csr")
        openssl(folder, "x509", "-req", "-in", f"{who}.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial",
                "-days", "2", "-extfile", "names", "-out", f"{who}.pem")


class StrictBroker(Broker):
    """At `url` it asks for a user, at `strict_url` for a certificate as well."""

    def __init__(self, folder):
        make_certificates(folder)
        subprocess.run(["mosquitto_passwd", "-b", "-c", "passwords", USER, PASSWORD], cwd=folder, check=True)
        (folder / "passwords").chmod(0o644)  # mosquitto gives up being root
        (folder / "broker.key").chmod(0o644)
        for name, text in (("user", f"{USER}:{PASSWORD}\n"), ("wrong_user", f"{USER}:wrong\n")):
            (folder / name).write_text(text)
            (folder / name).chmod(0o600)
        super().__init__(folder)
        self.url = f"mqtts://127.0.0.1:{self.port}"
        self.strict_url = f"mqtts://127.0.0.1:{self.strict_port}"

    def start(self):
        self.strict_port = free_port()
        listener = (f"cafile {self.folder}/ca.pem\ncertfile {self.folder}/broker.pem\n"
                    f"keyfile {self.folder}/broker.key\n")
        (self.folder / "broker.conf").write_text(
            f"per_listener_settings false\nallow_anonymous false\npassword_file {self.folder}/passwords\n"
            f"persistence false\nlistener {self.port} 127.0.0.1\n{listener}"
            f"listener {self.strict_port} 127.0.0.1\n{listener}require_certificate true\n")
        super().start()


class StrictLab(FleetLab):
    def __init__(self, scipd):
        super().__init__(scipd)
        self.broker.kill()
        self.folder.chmod(0o755)
        self.broker = StrictBroker(self.folder)
        self.trust = {"tls": {"ca": str(self.folder / "ca.pem")}}
        self.user = {"user_file": str(self.folder / "user")}

    def refused(self, name, why, exit_code=2, **fleet):
        """This daemon does not start, and says why."""
        daemon = self.start(name, **fleet)
        assert not daemon.ready, fleet
        assert daemon.end() == exit_code, daemon.log()
        assert why in daemon.log(), (why, daemon.log())


def main(scipd, scipctl):
    with StrictLab(scipd) as lab:
        one = lab.start("one", **lab.trust, **lab.user)
        assert one.ready, one.log()
        identity = {"ca": str(lab.folder / "ca.pem"), "cert": str(lab.folder / "daemon.pem"),
                    "key": str(lab.folder / "daemon.key")}
        two = lab.start("two", url=lab.broker.strict_url, **lab.user, tls=identity)
        assert two.ready, two.log()
        crate = {"name": "crate", "sdf": CRATE, "pose": {"xyz": [3, 0, 0.3]}}
        assert one.ask("POST", "/scene/models", crate)[0] == 201
        two.wait_to_see(2.75)
        (lab.folder / "post.sdf").write_text(BOX.format(name="post", pose="0 0 0", size="0.5 0.5 0.5"))
        subprocess.run([scipctl, "fleet", "add", "post", str(lab.folder / "post.sdf"), "--pose", "2,0,0.3,0,0,0",
                        "--to", f"{lab.broker.url}/hall", "--ca", identity["ca"], "--user-file",
                        lab.user["user_file"]], check=True, timeout=PATIENCE_S)
        for daemon in (one, two):
            daemon.wait_to_see(1.75)
        wait_for(lambda: two.ask("GET", "/status")[1]["fleet"]["daemons"] == 1, "the daemons do not see each other")

        lab.refused("untrusted", "`ca` must vouch", **lab.user, tls={"ca": str(lab.folder / "stranger.pem")})
        lab.refused("unknown", "user", **lab.trust, user_file=str(lab.folder / "wrong_user"))
        lab.refused("nobody", "user", **lab.trust)
        with FakeBroker(b"") as closed:
            lab.refused("early", "cannot join", exit_code=1, url=closed.url.replace("mqtt", "mqtts"), **lab.trust)
        # This broker hangs up without a word, as one may that is being started.
        lab.refused("anonymous", "cannot join", exit_code=1, url=lab.broker.strict_url, **lab.trust, **lab.user)
        for daemon in (one, two):
            assert daemon.end() == 0


main(*sys.argv[1:])
