//! Headless Chromium, controlled by its DevTools protocol: opens a page, evaluates expressions in it and uses the mouse.

use serde_json::{Value, json};
use std::fs;
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tungstenite::{Message, WebSocket};

/// How long the browser may take to respond.
const PATIENCE: Duration = Duration::from_secs(60);

pub struct Browser {
    child: Child,
    socket: WebSocket<TcpStream>,
    session: String,
    sent: u64,
    /// Exceptions, errors and warnings of the page so far.
    pub complaints: Vec<String>,
    _profile: tempfile::TempDir,
}

impl Browser {
    /// Starts the browser that `LARIAT_CHROMIUM` names, or `chromium`, without a network.
    pub fn start(width: u32, height: u32) -> Browser {
        let profile = tempfile::tempdir().unwrap();
        let program = std::env::var("LARIAT_CHROMIUM").unwrap_or("chromium".to_string());
        let child = Command::new(&program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-port=0", "--no-first-run"])
            // names are not found, and addresses lead nowhere
            .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--proxy-server=127.0.0.1:9", "--hide-scrollbars"])
            .arg(format!("--window-size={width},{height}"))
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .arg("about:blank")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("{program}: {error}; `.ci/view` installs it"));
        let file = profile.path().join("DevToolsActivePort");
        let text = wait_for(|| fs::read_to_string(&file).ok().filter(|text| text.lines().count() == 2));
        let (port, path) = text.split_once('\n').unwrap();
        let stream = TcpStream::connect(("127.0.0.1", port.parse().unwrap())).unwrap();
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let url = format!("ws://127.0.0.1:{port}{}", path.trim());
        let (socket, _) = tungstenite::client(url, stream).unwrap();
        let mut browser =
            Browser { child, socket, session: String::new(), sent: 0, complaints: Vec::new(), _profile: profile };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }))["targetId"].clone();
        let session = browser.call("Target.attachToTarget", json!({ "targetId": target, "flatten": true }));
        browser.session = session["sessionId"].as_str().unwrap().to_string();
        for domain in ["Page", "Runtime", "Log"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        browser.call("Emulation.setDeviceMetricsOverride", size);
        browser
    }

    /// Sends a command and waits for its answer; messages of the page in between are recorded.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.sent += 1;
        let mut message = json!({ "id": self.sent, "method": method, "params": parameters });
        if !self.session.is_empty() {
            message["sessionId"] = json!(self.session);
        }
        self.socket.send(Message::text(message.to_string())).unwrap();
        loop {
            let Message::Text(text) = self.socket.read().unwrap() else { continue };
            let mut answer: Value = serde_json::from_str(&text).unwrap();
            if answer["id"] == json!(self.sent) {
                assert!(answer["error"].is_null(), "{method}: {answer}");
                return answer["result"].take();
            }
            self.listen(&answer);
        }
    }

    fn listen(&mut self, event: &Value) {
        let said = &event["params"];
        match event["method"].as_str() {
            Some("Runtime.exceptionThrown") => self.complaints.push(said["exceptionDetails"].to_string()),
            Some("Runtime.consoleAPICalled") if said["type"] == "error" || said["type"] == "warning" => {
                self.complaints.push(said["args"].to_string());
            }
            Some("Log.entryAdded") if said["entry"]["level"] != "info" && said["entry"]["level"] != "verbose" => {
                self.complaints.push(said["entry"].to_string());
            }
            _ => {}
        }
    }

    /// Opens a file and waits until it has drawn its first frame.
    pub fn open(&mut self, file: &Path) {
        self.call("Page.navigate", json!({ "url": format!("file://{}", file.display()) }));
        let end = Instant::now() + PATIENCE;
        while self.ask("document.documentElement?.dataset.ready || ''") != "true" {
            assert!(Instant::now() < end, "the page never drew: {:?}", self.complaints);
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Returns the value of an expression in the page, as text.
    pub fn ask(&mut self, expression: &str) -> String {
        let question = json!({ "expression": format!("String({expression})"), "returnByValue": true });
        let answer = self.call("Runtime.evaluate", question);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].as_str().unwrap().to_string()
    }

    /// Sends a mouse event at a position in pixels.
    pub fn mouse(&mut self, kind: &str, x: f64, y: f64) {
        let buttons = u8::from(kind != "mouseReleased");
        let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": buttons, "clickCount": 1, "deltaX": 0, "deltaY": -400 });
        self.call("Input.dispatchMouseEvent", event);
    }

    /// Returns the middle of an element, in pixels.
    pub fn middle_of(&mut self, id: &str) -> (f64, f64) {
        let of = |side: &str, size: &str| {
            format!("(b => b.{side} + b.{size} / 2)(document.getElementById('{id}').getBoundingClientRect())")
        };
        (self.ask(&of("left", "width")).parse().unwrap(), self.ask(&of("top", "height")).parse().unwrap())
    }

    pub fn click(&mut self, id: &str) {
        let (x, y) = self.middle_of(id);
        self.mouse("mousePressed", x, y);
        self.mouse("mouseReleased", x, y);
    }

    /// Returns a screenshot of the page as PNG.
    pub fn picture(&mut self) -> Vec<u8> {
        use base64::Engine as _;
        let shot = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        base64::engine::general_purpose::STANDARD.decode(shot["data"].as_str().unwrap()).unwrap()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn wait_for<T>(mut look: impl FnMut() -> Option<T>) -> T {
    let end = Instant::now() + PATIENCE;
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(Instant::now() < end, "Chromium does not answer");
        std::thread::sleep(Duration::from_millis(20));
    }
}
