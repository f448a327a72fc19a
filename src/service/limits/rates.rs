//! Rates: by visitor and by address.
//!
//! An address may be that of a whole class behind one router, so it may do much; each browser in it is told from the
//! others by its cookie, and may do as much as one person does. Whoever comes without a cookie is one visitor with all
//! others of the address who do. What is left is told in every answer that is counted, by the fields of
//! draft-ietf-httpapi-ratelimit-headers: `RateLimit-Policy` and `RateLimit`.

use super::Client;
use crate::language::Text;
use crate::service::Config;
use crate::service::clock::Clock;
use crate::service::errors::Problem;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode};
use governor::middleware::StateInformationMiddleware;
use governor::state::keyed::DefaultKeyedStateStore;
use governor::{Quota, RateLimiter};
use std::hash::Hash;
use std::net::IpAddr;
use std::num::NonZeroU32;
use std::time::Duration;

/// Attempts to log in by one name from one address: this many at once, then one every so often.
const LOGINS_PER_MINUTE: u32 = 5;

/// The same by whatever names: a university's staff may be behind one address.
const LOGINS_PER_ADDRESS: u32 = 60;

/// Longest name by which attempts are told apart, in characters; a login is shorter.
const LONGEST_LOGIN: usize = 100;

/// Seconds in which a rate's quota comes back.
const WINDOW: u32 = 60;

const POLICY: HeaderName = HeaderName::from_static("ratelimit-policy");
const STANDING: HeaderName = HeaderName::from_static("ratelimit");

/// The rates.
#[derive(Debug)]
pub struct RateLimits {
    visitors: Rate<String>,
    addresses: Rate<IpAddr>,
    logins: Rate<LoginKey>,
    logins_of_address: Rate<IpAddr>,
}

/// How many requests whoever is told apart by a `K` may send: as many at once as in a minute, and then as they come back.
#[derive(Debug)]
struct Rate<K: Key> {
    name: &'static str,
    /// The kind of the problem.
    kind: &'static str,
    quota: u32,
    limiter: RateLimiter<K, DefaultKeyedStateStore<K>, Clock, StateInformationMiddleware>,
}

impl governor::clock::Clock for Clock {
    type Instant = Duration;

    fn now(&self) -> Duration {
        self.elapsed()
    }
}

/// What a request left of the quotas that it was counted by.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counted(Vec<RemainingQuota>);

#[derive(Clone, Debug, PartialEq, Eq)]
struct RemainingQuota {
    name: &'static str,
    quota: u32,
    left: u32,
    /// Seconds until the quota is whole again, or where nothing is left until the next request may come.
    seconds: u64,
}

impl RateLimits {
    /// The rates of a configuration.
    pub fn new(config: &Config, clock: &Clock) -> Self {
        Self {
            visitors: Rate::new("visitor", "rate-student", config.uploads_per_student, clock),
            addresses: Rate::new("address", "rate-address", config.uploads_per_address, clock),
            logins: Rate::new("login", "rate-login", LOGINS_PER_MINUTE, clock),
            logins_of_address: Rate::new("logins", "rate-login", LOGINS_PER_ADDRESS, clock),
        }
    }

    /// Counts a request that changes something; of one that brings a file also its visitor, who is known by `cookie` or
    /// else by the address alone.
    pub fn count(&self, client: &Client, is_upload: bool, cookie: Option<&str>) -> (Counted, Result<(), Problem>) {
        let mut counted = Counted::default();
        let mut result = self.addresses.count(&client.address, &mut counted);
        if result.is_ok() && is_upload {
            let visitor = cookie.map_or_else(|| client.address.to_string(), str::to_owned);
            result = self.visitors.count(&visitor, &mut counted);
        }
        (counted, result)
    }

    /// Counts an attempt to log in by a name: whoever guesses at one locks it for their address, and no other.
    pub fn login(&self, client: &Client, login: &str) -> Result<(), Problem> {
        let login = login.trim().chars().take(LONGEST_LOGIN).collect::<String>().to_ascii_lowercase();
        self.logins_of_address.count(&client.address, &mut Counted::default())?;
        self.logins.count(&LoginKey { login, address: client.address }, &mut Counted::default())
    }

    /// Forgets who has been quiet for long.
    pub fn tidy(&self) {
        self.visitors.limiter.retain_recent();
        self.addresses.limiter.retain_recent();
        self.logins.limiter.retain_recent();
        self.logins_of_address.limiter.retain_recent();
    }
}

impl<K: Key> Rate<K> {
    fn new(name: &'static str, kind: &'static str, per_minute: u32, clock: &Clock) -> Self {
        let quota = NonZeroU32::new(per_minute).unwrap_or(NonZeroU32::MIN);
        let states = DefaultKeyedStateStore::default();
        let limiter = RateLimiter::new(Quota::per_minute(quota), states, clock.clone());
        Self { name, kind, quota: quota.get(), limiter }
    }

    fn count(&self, key: &K, counted: &mut Counted) -> Result<(), Problem> {
        let (name, quota) = (self.name, self.quota);
        match self.limiter.check_key(key) {
            Ok(standing) => {
                let left = standing.remaining_burst_capacity();
                let used = u64::from(quota.saturating_sub(left));
                let seconds = (used * u64::from(WINDOW)).div_ceil(u64::from(quota));
                counted.0.push(RemainingQuota { name, quota, left, seconds });
                Ok(())
            }
            Err(until) => {
                let wait = until.wait_time_from(self.limiter.clock().elapsed());
                let seconds = (wait.as_secs_f64().ceil() as u64).max(1);
                counted.0.push(RemainingQuota { name, quota, left: 0, seconds });
                Err(too_many(self.kind, &key.whose()).retry_after(seconds))
            }
        }
    }
}

/// By what requests are told apart.
trait Key: Hash + Eq + Clone {
    /// From where the requests come that are counted together, in words.
    fn whose(&self) -> Text;
}

impl Key for String {
    fn whose(&self) -> Text {
        match self.parse::<IpAddr>() {
            Ok(address) => address.whose(),
            Err(_) => Text::new("from this browser", "このブラウザから"),
        }
    }
}

impl Key for IpAddr {
    fn whose(&self) -> Text {
        Text::new(format!("from the network address {self}"), format!("ネットワークアドレス {self} から"))
    }
}

/// Who tries to log in, from where.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct LoginKey {
    login: String,
    address: IpAddr,
}

impl Key for LoginKey {
    fn whose(&self) -> Text {
        self.address.whose()
    }
}

fn too_many(kind: &'static str, whose: &Text) -> Problem {
    Problem::new(
        StatusCode::TOO_MANY_REQUESTS,
        kind,
        format!("Too many requests came {} in a short time. Wait a little, and try again.", whose.en),
        format!("{}短時間に多くのリクエストが届いています。少し待ってから、もう一度試してください。", whose.ja),
    )
}

impl Counted {
    /// Tells what is left in the head of an answer.
    pub fn tell(&self, headers: &mut HeaderMap) {
        let policy = |left: &RemainingQuota| format!("\"{}\";q={};w={WINDOW}", left.name, left.quota);
        let standing = |left: &RemainingQuota| format!("\"{}\";r={};t={}", left.name, left.left, left.seconds);
        let lists: [(_, Vec<String>); 2] =
            [(POLICY, self.0.iter().map(policy).collect()), (STANDING, self.0.iter().map(standing).collect())];
        for (name, items) in lists {
            if let (false, Ok(value)) = (items.is_empty(), HeaderValue::from_str(&items.join(", "))) {
                headers.insert(name, value);
            }
        }
    }
}
